#pragma once

/// The version of these headers: `NADE_VERSION_NUMBER` grows from one to the next.
///
/// Until 1.0 a minor version may change everything, a patch nothing that compiled. Stable from one
/// patch to the next are the headers of nade/, docs/formats.md and the command line's options; the
/// fields of `ProxyTuning` and what `nade bench` measures are not.
#define NADE_VERSION_MAJOR 0
#define NADE_VERSION_MINOR 1
#define NADE_VERSION_PATCH 0
#define NADE_VERSION_NUMBER \
  (NADE_VERSION_MAJOR * 10000 + NADE_VERSION_MINOR * 100 + NADE_VERSION_PATCH)
#define NADE_VERSION "0.1.0"

namespace nade {

/// NADE_VERSION of the library that the program runs with.
[[nodiscard]] const char* version() noexcept;

}  // namespace nade
