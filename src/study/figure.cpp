#include "nade/study/figure.h"

#include "answer_sheet.h"

namespace nade::study {
namespace {

Figure figure_of(const std::string& name, const Sheet& sheet) {
  return {name, figure_script(name, sheet), figure_data(sheet)};
}

}  // namespace

Figure answers_figure(const StudyData& data, const Analysis& analysis, Language language) {
  return figure_of("fig3", {data, analysis, analysis.averaged, {Panel{}}, language});
}

Figure answers_by_object_figure(const StudyData& data, const Analysis& analysis,
                                Language language) {
  Sheet sheet{data, analysis, analysis.by_object, {}, language, QuestionTexts::names_only};
  for (const std::string& object : data.objects) sheet.panels.push_back({object, object});
  return figure_of("fig3_by_object", sheet);
}

std::string significance_mark(double p) {
  if (p < 0.01) return "**";
  return p < 0.05 ? "*" : "n.s.";
}

std::string method_label(const Analysis& analysis, const std::string& method, Language language) {
  const bool japanese = language == Language::japanese;
  if (method == analysis.methods.front()) return japanese ? "補正なし" : "without correction";
  const std::string with = japanese ? "補正あり" : "with correction";
  return analysis.methods.size() == 2 ? with : with + ": " + method;
}

}  // namespace nade::study
