#include <string_view>

#include "nade.h"
#include "nade/hand.h"
#include "nade/version.h"

extern "C" {

uint32_t nade_abi_version(void) noexcept { return NADE_ABI_VERSION; }

const char* nade_version(void) noexcept { return nade::version(); }

int32_t nade_has(nade_capability capability) noexcept {
  return capability == NADE_CAN_CORRECT ? 1 : 0;
}

const char* nade_status_text(nade_status status) noexcept {
  switch (status) {
    case NADE_OK:
      return "no error";
    case NADE_ERROR_ARGUMENT:
      return "an argument is NULL, not finite or out of range";
    case NADE_ERROR_HANDLE:
      return "a handle is NULL, was destroyed or is of another kind";
    case NADE_ERROR_SIZE:
      return "a struct's size is not known";
    case NADE_ERROR_ID:
      return "an object's id is taken, or not there";
    case NADE_ERROR_DATA:
      return "the data cannot be used";
    case NADE_ERROR_MEMORY:
      return "no memory is left";
    case NADE_ERROR_INTERNAL:
      return "a bug in nade";
    default:
      return "an unknown code";
  }
}

const char* nade_fault_text(nade_fault fault) noexcept {
  if (fault == NADE_FAULT_NONE) return "no fault";
  if (fault < NADE_FAULT_NONE || fault > NADE_FAULT_NO_LENGTH) return "an unknown fault";
  return nade::name_of(static_cast<nade::HandFault>(fault - 1)).data();  // of a literal
}

}  // extern "C"
