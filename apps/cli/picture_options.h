#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_files.h"
#include "nade/draw/stage.h"
#include "nade/status.h"

namespace nade::cli {

/// --hand-left and --hand-right: skinned hands of one's own.
struct HandFiles {
  std::array<std::optional<std::string>, 2> file{};  ///< by index_of(Handedness)
};
void add_hand_options(CLI::App& command, HandFiles& options);

/// The files, as the command line calls them.
[[nodiscard]] std::vector<NamedFile> hand_files(const HandFiles& files);

/// The hands to draw: the files that were given, or the hand that comes with nade.
[[nodiscard]] Result<draw::HandMeshes> load_hands(const HandFiles& files);

/// Lets a method know the flesh of the hands that were given, in place of the generic hand's.
void use_own_hands(const HandFiles& files, const draw::HandMeshes& hands,
                   CorrectorOptions& options);

/// Refuses a name of a picture that does not end in .png: PNG is what is written.
[[nodiscard]] Status check_png(const std::string& option, const std::string& name);

/// --size WIDTHxHEIGHT.
struct PictureSize {
  int width = 1280;
  int height = 720;
  [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
};
void add_size_option(CLI::App& command, PictureSize& size);

/// --overlay: names parted by commas.
void add_overlay_option(CLI::App& command, draw::Overlays& overlays);

/// --show raw|corrected|both.
void add_show_option(CLI::App& command, std::optional<draw::Shown>& shown);

}  // namespace nade::cli
