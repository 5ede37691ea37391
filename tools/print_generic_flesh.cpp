// Prints src/hand/generic_flesh_table.h, the built-in hand's pads as numbers, from the right hand's
// mesh: print_generic_flesh hands/right.glb >src/hand/generic_flesh_table.h, then make format.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "nade/flesh.h"
#include "nade/io/hand_file.h"

namespace {

using nade::FleshPoint;
using nade::HandFlesh;
using nade::HandMesh;

/// Hundredths of a millimetre and thousandths of the whole.
std::string row_of(const FleshPoint& point, const HandMesh& mesh) {
  const nade::Vec3 position = nade::position_of(point, mesh.bind, 1.0);
  std::string text = fmt::format("{{{}, {}, {}", std::lround(1e5 * position.x()),
                                 std::lround(1e5 * position.y()), std::lround(1e5 * position.z()));
  for (std::size_t k = 0; k < 4; ++k) {
    text += fmt::format(", {}, {}", point.joints[k], std::lround(1e3F * point.shares[k].w()));
  }
  return text + "}";
}

std::string palmar_of(const nade::FleshPad& pad, const HandMesh& mesh) {
  if (!pad.palmar) return "0, 0, {{}}";
  return fmt::format("{}, {}, {{{}}}", std::lround(1e6 * pad.palmar->area_m2),
                     static_cast<int>(pad.palmar->region), row_of(pad.palmar->middle, mesh));
}

void print(const HandFlesh& flesh, const HandMesh& mesh) {
  fmt::print(
      "#pragma once\n\n"
      "// Measured on the right hand of @webxr-input-profiles/assets 1.0.20 by\n"
      "// tools/print_generic_flesh; not to be edited.\n\n"
      "#include <array>\n#include <cstdint>\n\n"
      "namespace nade::detail {{\n\n"
      "/// Bind pose: position, metres, and rotation x, y, z, w of each joint.\n"
      "inline constexpr std::array<std::array<double, 7>, 26> kBind{{{{\n");
  for (const nade::Pose& joint : mesh.bind.joints) {
    const nade::Vec3& p = joint.position;
    const nade::Quat& q = joint.rotation;
    fmt::print("{{{:.6f}, {:.6f}, {:.6f}, {:.6f}, {:.6f}, {:.6f}, {:.6f}}},\n", p.x(), p.y(), p.z(),
               q.x(), q.y(), q.z(), q.w());
  }
  fmt::print(
      "}}}};\n\n"
      "/// A point in the bind pose, hundredths of a millimetre, and four joints with their "
      "weights,\n"
      "/// thousandths.\n"
      "using FleshRow = std::array<std::int16_t, 11>;\n\n"
      "struct PadRow {{\n  std::int16_t part;  ///< -1: of no part's patch\n"
      "  std::int16_t count;  ///< of skin rows\n  FleshRow middle;\n"
      "  std::int16_t area_mm2;  ///< of palmar skin\n"
      "  std::int16_t region;  ///< as SkinRegion\n  FleshRow palmar;\n}};\n"
      "inline constexpr std::array<PadRow, {}> kPads{{{{\n",
      flesh.pads.size());
  for (const nade::FleshPad& pad : flesh.pads) {
    fmt::print("{{{}, {}, {{{}}}, {}}},\n", pad.part ? static_cast<int>(*pad.part) : -1, pad.count,
               row_of(pad.middle, mesh), palmar_of(pad, mesh));
  }
  fmt::print("}}}};\n\ninline constexpr std::array<FleshRow, {}> kSkin{{{{\n", flesh.skin.size());
  for (const FleshPoint& point : flesh.skin) fmt::print("{{{}}},\n", row_of(point, mesh));
  fmt::print(
      "}}}};\n\n/// How far the flesh gives way at each, hundredths of a millimetre.\n"
      "inline constexpr std::array<std::int16_t, {}> kSkinDepths{{{{\n",
      flesh.depth_m.size());
  for (const double depth_m : flesh.depth_m) fmt::print("{}, ", std::lround(1e5 * depth_m));
  fmt::print("}}}};\n\n}}  // namespace nade::detail\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: print_generic_flesh RIGHT.glb\n");
    return 2;
  }
  const nade::Result<HandMesh> mesh = nade::load_hand_mesh(argv[1], nade::Handedness::right);
  if (!mesh) {
    fmt::print(stderr, "print_generic_flesh: {}\n", mesh.error().message);
    return 1;
  }
  print(nade::measure_flesh(*mesh), *mesh);
  return 0;
}
