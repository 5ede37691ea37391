#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "nade/status.h"
#include "nade/study/analysis.h"
#include "nade/study/plan.h"
#include "nade/study/study_data.h"

namespace nade::study {

/// A figure as a gnuplot script and the data that it draws; both are named after it ("fig3.gp",
/// "fig3.dat"), and so are the pictures.
struct Figure {
  std::string name;
  std::string script;
  std::string data;
};

/// The paper's Fig. 3: every single answer to each question under each method, as dots and boxes,
/// all objects together; brackets bear the marks of `analysis.averaged`. Texts of questions in
/// `language`, where there are any. SIMULATED stands across it where the data are.
[[nodiscard]] Figure answers_figure(const StudyData& data, const Analysis& analysis,
                                    Language language);

/// The same for each object, side by side, with the marks of `analysis.by_object`.
[[nodiscard]] Figure answers_by_object_figure(const StudyData& data, const Analysis& analysis,
                                              Language language);

/// "**" below 0.01, "*" below 0.05, else "n.s.".
[[nodiscard]] std::string significance_mark(double p);

/// What a method is called where people read it: "without correction" the baseline, the others
/// "with correction", with their names where there are several.
[[nodiscard]] std::string method_label(const Analysis& analysis, const std::string& method,
                                       Language language);

/// A line as a string of gnuplot's. In single quotes it replaces nothing, where in double ones it
/// runs what stands in backticks.
[[nodiscard]] std::string gnuplot_string(std::string_view line);

/// What became of the pictures.
struct DrawnFigure {
  std::vector<std::string> files;  ///< that appeared: NAME.svg, NAME.pdf, NAME.png
  std::string problem;             ///< one sentence where there are none; empty else
};

/// Writes script and data into a folder that is there, and has gnuplot draw them. Without gnuplot,
/// or if it fails, there are no pictures, and that is no error.
[[nodiscard]] Result<DrawnFigure> draw_figure(const Figure& figure, const std::string& folder);

}  // namespace nade::study
