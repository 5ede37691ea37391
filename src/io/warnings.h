#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace nade::io {

/// What can be odd about a recording without being fatal.
enum class Oddity {
  cut_off,
  unusable_hand,
  rotation_not_unit,
  time_not_advancing,
  hand_twice,
  finger_missing,
  palm_missing,
  time_missing,
  picture_size_missing,
  picture_missing,
  depth_missing,
  shape_missing,
  unit_guessed,
  metacarpal_missing,
  joint_missing,
  up_guessed,
};

/// Counts oddities and keeps the first of each kind.
class Warnings {
 public:
  /// `sentence` names the file, the place, and what was done about it.
  void add(Oddity oddity, const std::string& sentence);
  /// The same of what holds for a whole file: further ones are not counted.
  void add_once(Oddity oddity, const std::string& sentence);

  /// One sentence a kind, with how many more there were.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Entry {
    Oddity oddity;
    std::string first;
    std::size_t count;
  };
  std::vector<Entry> entries_;
};

}  // namespace nade::io
