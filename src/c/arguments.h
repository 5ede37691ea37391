#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "failure.h"
#include "handle.h"

namespace nade::c_abi {

/// Where a struct that begins with its size may end: behind each of its fields but the first.
template <class Struct>
struct FieldEnds;

/// Checks of a call's arguments. Of several that are wrong the first is told; the rest are then
/// not looked at.
class Arguments {
 public:
  [[nodiscard]] bool ok() const { return status_ == NADE_OK; }
  [[nodiscard]] nade_status status() const { return status_; }

  Arguments& given(const void* pointer, const char* name) {
    if (ok() && pointer == nullptr) {
      status_ = fail(NADE_ERROR_ARGUMENT, "%s: expected a pointer, found NULL", name);
    }
    return *this;
  }

  template <class Handle>
  Arguments& handle(const Handle* handle, const char* name) {
    if (ok()) status_ = check_handle(handle, name);
    return *this;
  }

  /// Not where it is no number either.
  Arguments& within(double value, double least, double most, const char* name) {
    if (ok() && !(value >= least && value <= most)) {
      status_ =
          fail(NADE_ERROR_ARGUMENT, "%s: expected %g to %g, found %g", name, least, most, value);
    }
    return *this;
  }

  Arguments& above_zero(double value, const char* name) {
    if (ok() && !(std::isfinite(value) && value > 0.0)) {
      status_ = fail(NADE_ERROR_ARGUMENT, "%s: expected a number above 0, found %g", name, value);
    }
    return *this;
  }

  template <class Number>
  Arguments& finite(const Number* values, std::size_t count, const char* name) {
    for (std::size_t i = 0; ok() && i < count; ++i) {
      if (std::isfinite(values[i])) continue;
      status_ = fail(NADE_ERROR_ARGUMENT, "%s: expected finite numbers, found %g at %zu", name,
                     static_cast<double>(values[i]), i);
    }
    return *this;
  }

  Arguments& at_least(std::size_t count, std::size_t least, const char* name) {
    if (ok() && count < least) {
      status_ =
          fail(NADE_ERROR_ARGUMENT, "%s: expected at least %zu, found %zu", name, least, count);
    }
    return *this;
  }

  Arguments& side(nade_side side) {
    if (ok() && side != NADE_LEFT && side != NADE_RIGHT) {
      status_ = fail(NADE_ERROR_ARGUMENT, "side: expected NADE_LEFT or NADE_RIGHT, found %d", side);
    }
    return *this;
  }

  Arguments& expects(bool condition, nade_status status, const char* sentence) {
    if (ok() && !condition) status_ = fail(status, "%s", sentence);
    return *this;
  }

  /// NULL is none.
  Arguments& placement(const nade_placement* placement);

  /// A struct that begins with its size.
  template <class Struct>
  Arguments& sized(const Struct* given_struct, const char* name) {
    given(given_struct, name);
    if (ok() && !has_known_size(*given_struct)) {
      status_ = fail(NADE_ERROR_SIZE, "%s: expected sizeof(%s) = %zu as its size, found %u", name,
                     FieldEnds<Struct>::kName, sizeof(Struct), given_struct->size);
    }
    return *this;
  }

  /// One that is read: what a longer one has beyond the known fields must be 0.
  template <class Struct>
  Arguments& read(const Struct* given_struct, const char* name) {
    sized(given_struct, name);
    if (!ok()) return *this;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(given_struct);
    for (std::size_t i = sizeof(Struct); i < given_struct->size; ++i) {
      if (bytes[i] == 0) continue;
      status_ = fail(NADE_ERROR_SIZE, "%s: a field that this library does not know is not 0", name);
      break;
    }
    return *this;
  }

 private:
  template <class Struct>
  [[nodiscard]] static bool has_known_size(const Struct& value) {
    // A size that was never set is told: no struct will grow by that.
    constexpr std::size_t kMostNew = 4096;
    if (value.size >= sizeof(Struct)) return value.size <= sizeof(Struct) + kMostNew;
    for (const std::size_t end : FieldEnds<Struct>::kEnds) {
      if (value.size == end) return true;
    }
    return false;
  }

  nade_status status_ = NADE_OK;
};

/// The fields that are there, over those of `defaults`.
template <class Struct>
[[nodiscard]] Struct with_defaults(const Struct& given, Struct defaults) {
  std::memcpy(&defaults, &given, given.size < sizeof(Struct) ? given.size : sizeof(Struct));
  defaults.size = sizeof(Struct);
  return defaults;
}

/// Writes the fields that `target` has room for; what it has beyond them becomes 0.
template <class Struct>
void write(const Struct& value, Struct& target) {
  constexpr std::size_t kFirst = sizeof(target.size);
  const std::size_t size = target.size;
  auto* const bytes = reinterpret_cast<unsigned char*>(&target);
  const std::size_t known = size < sizeof(Struct) ? size : sizeof(Struct);
  std::memcpy(bytes + kFirst, reinterpret_cast<const unsigned char*>(&value) + kFirst,
              known - kFirst);
  std::memset(bytes + known, 0, size - known);
}

template <class Struct, class Field>
[[nodiscard]] constexpr std::size_t size_of(Field Struct::* /*field*/) {
  return sizeof(Field);  // NOLINT(bugprone-sizeof-expression): of pointers, too
}

#define NADE_C_END(type, field) (offsetof(type, field) + size_of(&type::field))

template <>
struct FieldEnds<nade_feel> {
  static constexpr const char* kName = "nade_feel";
  static constexpr std::array kEnds{
      NADE_C_END(nade_feel, softness_m), NADE_C_END(nade_feel, softness_depth_m),
      NADE_C_END(nade_feel, friction), NADE_C_END(nade_feel, friction_kinetic)};
};
template <>
struct FieldEnds<nade_corrector_options> {
  static constexpr const char* kName = "nade_corrector_options";
  static constexpr std::array kEnds{
      NADE_C_END(nade_corrector_options, method), NADE_C_END(nade_corrector_options, release_s),
      NADE_C_END(nade_corrector_options, hand_length_m), NADE_C_END(nade_corrector_options, feel),
      NADE_C_END(nade_corrector_options, left_flesh)};
};
template <>
struct FieldEnds<nade_result> {
  static constexpr const char* kName = "nade_result";
  static constexpr std::array kEnds{NADE_C_END(nade_result, status), NADE_C_END(nade_result, fault),
                                    NADE_C_END(nade_result, contact_count),
                                    NADE_C_END(nade_result, joints),
                                    NADE_C_END(nade_result, velocity_mps)};
};
template <>
struct FieldEnds<nade_mesh_report> {
  static constexpr const char* kName = "nade_mesh_report";
  static constexpr std::array kEnds{NADE_C_END(nade_mesh_report, solid),
                                    NADE_C_END(nade_mesh_report, triangles_used),
                                    NADE_C_END(nade_mesh_report, triangles_degenerate),
                                    NADE_C_END(nade_mesh_report, triangles_duplicate),
                                    NADE_C_END(nade_mesh_report, triangles_turned),
                                    NADE_C_END(nade_mesh_report, border_edges)};
};
// Of no use without all of their fields.
template <>
struct FieldEnds<nade_mesh> {
  static constexpr const char* kName = "nade_mesh";
  static constexpr std::array<std::size_t, 0> kEnds{};
};
template <>
struct FieldEnds<nade_hand_mesh> {
  static constexpr const char* kName = "nade_hand_mesh";
  static constexpr std::array<std::size_t, 0> kEnds{};
};
template <>
struct FieldEnds<nade_surface_callbacks> {
  static constexpr const char* kName = "nade_surface_callbacks";
  static constexpr std::array kEnds{NADE_C_END(nade_surface_callbacks, closest_point),
                                    NADE_C_END(nade_surface_callbacks, first_hit),
                                    NADE_C_END(nade_surface_callbacks, shape),
                                    NADE_C_END(nade_surface_callbacks, bounds)};
};

#undef NADE_C_END

}  // namespace nade::c_abi
