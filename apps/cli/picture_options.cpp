#include "picture_options.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

#include "commands.h"
#include "nade/flesh.h"
#include "nade/io/assets.h"
#include "nade/io/hand_file.h"
#include "number_list.h"

namespace nade::cli {
namespace {

constexpr int kLargestSide = 8192;

struct OverlayName {
  const char* name;
  bool draw::Overlays::*member;
};
constexpr std::array<OverlayName, 7> kOverlays{{{"rays", &draw::Overlays::rays},
                                                {"contacts", &draw::Overlays::contacts},
                                                {"normals", &draw::Overlays::normals},
                                                {"held-ray", &draw::Overlays::held_ray},
                                                {"penetration", &draw::Overlays::penetration},
                                                {"labels", &draw::Overlays::labels},
                                                {"see-through", &draw::Overlays::see_through}}};

std::string overlay_names() {
  std::string names;
  for (const OverlayName& overlay : kOverlays) {
    names += fmt::format("{}{}", names.empty() ? "" : ",", overlay.name);
  }
  return names;
}

std::string option_of(Handedness side) { return fmt::format("--hand-{}", name_of(side)); }

}  // namespace

void add_hand_options(CLI::App& command, HandFiles& options) {
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    command
        .add_option(option_of(side), options.file[index_of(side)],
                    fmt::format("a skinned {} hand of your own (.glb, .gltf), with the joints of "
                                "WebXR by name",
                                name_of(side)))
        ->type_name("FILE");
  }
}

std::vector<NamedFile> hand_files(const HandFiles& files) {
  return {{option_of(Handedness::left), files.file[index_of(Handedness::left)]},
          {option_of(Handedness::right), files.file[index_of(Handedness::right)]}};
}

Result<draw::HandMeshes> load_hands(const HandFiles& files) {
  draw::HandMeshes hands;
  for (const Handedness side : {Handedness::left, Handedness::right}) {
    Result<std::string> path = files.file[index_of(side)]
                                   ? Result<std::string>(*files.file[index_of(side)])
                                   : find_asset(fmt::format("hands/{}.glb", name_of(side)));
    if (!path) return path.error();
    Result<HandMesh> mesh = load_hand_mesh(*path, side);
    if (!mesh) return mesh.error();
    hands[index_of(side)] = std::move(mesh).value();
  }
  return hands;
}

void use_own_hands(const HandFiles& files, const draw::HandMeshes& hands,
                   CorrectorOptions& options) {
  for (std::size_t side = 0; side < hands.size(); ++side) {
    if (!files.file[side]) continue;
    options.flesh[side] = std::make_shared<const HandFlesh>(measure_flesh(hands[side]));
    options.skin = measure_skin_depths(hands[side]);
    options.skin_hand_length_m = hand_length(hands[side].bind);
  }
}

Status check_png(const std::string& option, const std::string& name) {
  if (name.ends_with(".png")) return ok_status();
  return misuse(fmt::format("{}: expected a name ending in .png, found '{}'", option, name));
}

void add_size_option(CLI::App& command, PictureSize& size) {
  command
      .add_option_function<std::string>(
          "--size",
          [&size](const std::string& text) {
            const auto numbers = parse_numbers<2>(text, 'x');
            const auto whole = [](double n) {
              return n >= 16.0 && n <= kLargestSide && n == std::round(n);
            };
            if (!numbers || !whole((*numbers)[0]) || !whole((*numbers)[1])) {
              throw CLI::ValidationError(
                  "--size", fmt::format("expected WIDTHxHEIGHT, each 16 to {}, found '{}'",
                                        kLargestSide, text));
            }
            size.width = static_cast<int>((*numbers)[0]);
            size.height = static_cast<int>((*numbers)[1]);
          },
          "in pixels (default 1280x720)")
      ->type_name("WxH");
}

void add_overlay_option(CLI::App& command, draw::Overlays& overlays) {
  command
      .add_option_function<std::string>(
          "--overlay",
          [&overlays](const std::string& text) {
            std::istringstream names(text);
            for (std::string name; std::getline(names, name, ',');) {
              bool known = false;
              for (const OverlayName& overlay : kOverlays) {
                if (name != overlay.name) continue;
                overlays.*overlay.member = known = true;
              }
              if (!known) {
                throw CLI::ValidationError(
                    "--overlay",
                    fmt::format("expected some of {}, found '{}'", overlay_names(), name));
              }
            }
            // Skin that is in the object could not be seen otherwise.
            if (overlays.penetration) overlays.see_through = true;
          },
          "what is drawn on top")
      ->type_name(overlay_names());
}

void add_show_option(CLI::App& command, std::optional<draw::Shown>& shown) {
  command
      .add_option_function<std::string>(
          "--show",
          [&shown](const std::string& text) {
            if (text == "raw") {
              shown = draw::Shown::tracked;
            } else if (text == "corrected") {
              shown = draw::Shown::corrected;
            } else if (text == "both") {
              shown = draw::Shown::both;
            } else {
              throw CLI::ValidationError(
                  "--show", fmt::format("expected raw, corrected or both, found '{}'", text));
            }
          },
          "which hand; both: the tracked one as a ghost (default corrected)")
      ->type_name("raw|corrected|both");
}

}  // namespace nade::cli
