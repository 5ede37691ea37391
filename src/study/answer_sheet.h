#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nade/study/analysis.h"
#include "nade/study/plan.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// Answers that are drawn side by side: one panel of a figure.
struct Panel {
  std::string title;
  std::string object;  ///< empty: all of them
};

/// Whether the questions' texts stand under the axis, or only their names.
enum class QuestionTexts { shown, names_only };

/// What a figure is made from.
struct Sheet {
  const StudyData& data;
  const Analysis& analysis;
  std::span<const Comparison> comparisons;  ///< the family of its marks
  std::vector<Panel> panels;
  Language language;
  QuestionTexts texts = QuestionTexts::shown;
};

/// Where things are in a panel. Across, one is the place of one method; up, one is a point of the
/// answers' scale.
class Places {
 public:
  explicit Places(const Sheet& sheet)
      : methods_(static_cast<double>(sheet.analysis.methods.size())),
        questions_(static_cast<double>(sheet.data.questions.size())),
        scale_high_(sheet.data.scale_high) {}

  [[nodiscard]] double centre(std::size_t question, std::size_t method) const {
    return static_cast<double>(question) * group_width() + static_cast<double>(method);
  }
  [[nodiscard]] double group_width() const { return methods_ + kGroupGap; }
  [[nodiscard]] double group_centre(std::size_t question) const {
    return centre(question, 0) + 0.5 * (methods_ - 1.0);
  }
  [[nodiscard]] double left() const { return -0.5 - 0.5 * kGroupGap; }
  [[nodiscard]] double right() const { return left() + questions_ * group_width(); }
  /// The height of the bracket from the baseline to a method.
  [[nodiscard]] double bracket(std::size_t method) const {
    return scale_high_ + kBracketStep * static_cast<double>(method) - 0.1;
  }
  [[nodiscard]] double top() const { return scale_high_ + kBracketStep * methods_ - 0.05; }

 private:
  static constexpr double kGroupGap = 0.7;
  static constexpr double kBracketStep = 0.62;

  double methods_;
  double questions_;
  double scale_high_;
};

/// The data file of a figure: blocks that its script asks for by their names.
[[nodiscard]] std::string figure_data(const Sheet& sheet);

/// The script that draws it as NAME.svg, NAME.pdf and NAME.png.
[[nodiscard]] std::string figure_script(const std::string& name, const Sheet& sheet);

}  // namespace nade::study
