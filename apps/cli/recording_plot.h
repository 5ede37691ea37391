#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "nade/io/recording.h"

namespace nade::cli {

/// A page about a recording, gathered a frame at a time in bounded memory: over time where each
/// palm is, how fast it goes, how far the fingers bend, how long the hand is, how it trembles, and
/// where it is missing.
class RecordingPlot {
 public:
  void add(const RecordedFrame& frame);

  /// Draws the page: an SVG, PDF or PNG picture by the ending of `path`. `title` is the recording's
  /// name.
  [[nodiscard]] Status draw(const std::string& title, const std::string& path) const;

 private:
  /// What is drawn of a hand: x, y, z, speed, bends of the five digits, length, tremble.
  static constexpr std::size_t kValues = 6 + kDigitCount;

  struct Spread {
    double sum = 0.0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = -std::numeric_limits<double>::infinity();
    std::size_t count = 0;

    void add(double value);
    void add(const Spread& other);
  };
  /// Some frames that follow one another.
  struct Span {
    double begin_s = 0.0;
    double end_s = 0.0;
    std::array<std::array<Spread, kValues>, 2> hands{};  ///< by index_of(Handedness)
  };
  /// A palm in the frames before.
  struct Past {
    std::optional<Vec3> last;
    std::optional<Vec3> last_but_one;
  };

  void add_hand(const RecordedHand& hand, double step_s, Span& span);
  void thin_out();
  [[nodiscard]] bool has_hand(std::size_t side) const;
  [[nodiscard]] static std::string row_of(const Span& span, std::size_t side);
  [[nodiscard]] std::string data() const;
  [[nodiscard]] std::string gaps(std::size_t side) const;
  [[nodiscard]] std::string column(std::size_t side) const;
  [[nodiscard]] std::string script(const std::string& title) const;

  std::vector<Span> spans_;
  std::size_t frames_a_span_ = 1;
  std::size_t frames_in_last_ = 0;
  std::size_t frames_ = 0;
  std::optional<std::int64_t> first_ns_;
  std::int64_t last_ns_ = 0;
  std::array<Past, 2> past_;
};

}  // namespace nade::cli
