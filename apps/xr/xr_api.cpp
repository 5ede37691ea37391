#include "xr_api.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <openxr/openxr_reflection.h>

#include <cstdlib>

namespace nade::xr {
namespace {

template <class Function>
void find(PFN_xrGetInstanceProcAddr get, XrInstance instance, const char* name, Function& into) {
  PFN_xrVoidFunction found = nullptr;
  if (XR_FAILED(get(instance, name, &found))) found = nullptr;
  into = reinterpret_cast<Function>(found);
}

}  // namespace

Result<XrApi> XrApi::open() {
  // It would tell at length what we tell in a sentence.
  setenv("XR_LOADER_DEBUG", "none", 0);
  // Stays open: runtimes do not like to be unloaded.
  void* const library = dlopen("libopenxr_loader.so.1", RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return Error{ErrorCode::not_found,
                 "a headset is reached through OpenXR's loader, and libopenxr_loader.so.1 is not "
                 "on this machine: install it (Debian: libopenxr-loader1)"};
  }
  XrApi api;
  api.get = reinterpret_cast<PFN_xrGetInstanceProcAddr>(dlsym(library, "xrGetInstanceProcAddr"));
  if (api.get == nullptr) {
    return Error{ErrorCode::bad_format,
                 "libopenxr_loader.so.1: expected the function xrGetInstanceProcAddr, found none"};
  }
  find(api.get, XR_NULL_HANDLE, "xrEnumerateInstanceExtensionProperties",
       api.xrEnumerateInstanceExtensionProperties);
  find(api.get, XR_NULL_HANDLE, "xrEnumerateApiLayerProperties", api.xrEnumerateApiLayerProperties);
  find(api.get, XR_NULL_HANDLE, "xrCreateInstance", api.xrCreateInstance);
  return api;
}

void XrApi::load(XrInstance instance) {
#define NADE_XR_FIND(name) find(get, instance, #name, name);
  NADE_XR_FUNCTIONS(NADE_XR_FIND)
#undef NADE_XR_FIND
}

std::string name_of(XrResult result) {
  switch (result) {
#define NADE_XR_NAME(name, value) \
  case name:                      \
    return #name;
    XR_LIST_ENUM_XrResult(NADE_XR_NAME)
#undef NADE_XR_NAME
        default : return fmt::format("XrResult {}", static_cast<int>(result));
  }
}

}  // namespace nade::xr
