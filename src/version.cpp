#include "nade/version.h"

namespace nade {

const char* version() noexcept { return NADE_VERSION; }

}  // namespace nade
