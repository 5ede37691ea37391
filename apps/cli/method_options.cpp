#include "method_options.h"

#include <fmt/format.h>

#include <vector>

#include "choice_option.h"
#include "commands.h"
#include "number_list.h"
#include "number_options.h"

namespace nade::cli {
namespace {

constexpr const char* kGroup = "Open points of --method paper (docs/paper.md)";
constexpr const char* kMethod = "--method";
constexpr const char* kSoftness = "--softness";
constexpr const char* kFriction = "--friction";

const std::vector<Choice<Method>>& methods() {
  static const std::vector<Choice<Method>> kMethods{
      {"nade", Method::nade}, {"paper", Method::paper}, {"none", Method::none}};
  return kMethods;
}

/// Metres, or millimetres where it says so. A plain number too large for metres was meant in
/// millimetres, which were the option's unit before.
std::optional<double> softness_from_text(std::string text) {
  const bool mm = text.ends_with("mm");
  if (mm) text.resize(text.size() - 2);
  const auto number = parse_numbers<1>(text);
  if (!number) return std::nullopt;
  double softness_m = number->front();
  if (mm || softness_m > kSoftest_m) softness_m *= 0.001;
  if (!(softness_m >= 0.0 && softness_m <= kSoftest_m)) return std::nullopt;
  return softness_m;
}

void add_open_points(CLI::App& command, CorrectorOptions& options) {
  ContactOptions& contact = options.contact;
  add_choice<TestPoint>(command, "--test-point", contact.test_point,
                        {{"skin", TestPoint::skin}, {"joint", TestPoint::joint}},
                        "what is tested against the surface (default skin)")
      ->group(kGroup);
  add_choice<CountedHits>(command, "--hits", contact.counted_hits,
                          {{"from-inside", CountedHits::from_inside}, {"any", CountedHits::any}},
                          "which hits of a ray count (default from-inside)")
      ->group(kGroup);
  add_choice<FingerRay>(
      command, "--finger-ray", contact.finger_ray,
      {{"hand-back", FingerRay::hand_back}, {"fingertip-back", FingerRay::fingertip_back}},
      "where a fingertip's ray goes (default hand-back)")
      ->group(kGroup);
  add_choice<PalmRay>(command, "--palm-ray", contact.palm_ray,
                      {{"held", PalmRay::held}, {"follows-hand", PalmRay::follows_hand}},
                      "the palm's ray while the palm is below (default held)")
      ->group(kGroup);
  add_choice<EntrySide>(
      command, "--entry-side", contact.entry_side,
      {{"remembered", EntrySide::remembered}, {"forgotten", EntrySide::forgotten}},
      "of a part pushed through a thin wall (default remembered)")
      ->group(kGroup);
  add_choice<SkinSource>(command, "--skin", options.skin_source,
                         {{"radii", SkinSource::radii}, {"mesh", SkinSource::mesh}},
                         "where fingertip thickness comes from (default radii)")
      ->group(kGroup);
  command
      .add_option("--full-turn-depth", contact.full_turn_depth_m,
                  "depth at which the palm lies along the surface")
      ->type_name("M")
      ->check(number_in(0.0, 0.2))
      ->capture_default_str()
      ->group(kGroup);
  command
      .add_option_function<double>(
          "--max-ray-turn",
          [&options](const double& degrees) {
            options.fingers.max_ray_turn_rad = degrees * kDegree;
          },
          "farthest turn of a fingertip's ray toward extension (default 80)")
      ->type_name("DEG")
      ->check(number_in(0.0, 90.0))
      ->group(kGroup);
  command
      .add_option("--release", options.release_s,
                  "time over which what is left of a correction fades")
      ->type_name("S")
      ->check(number_in(0.0, 1.0))
      ->capture_default_str()
      ->group(kGroup);
}

/// The one method that an option has an effect on, where there is one.
std::optional<Method> method_of(const CLI::Option& option) {
  if (option.get_group() == kGroup) return Method::paper;
  const std::string name = option.get_name();
  if (name == kSoftness || name == kFriction) return Method::nade;
  return std::nullopt;
}

}  // namespace

void add_method_options(CLI::App& command, MethodOptions& options) {
  options.command = &command;
  add_choice<Method>(command, kMethod, options.corrector.method, methods(),
                     "how to correct (default nade)");
  command
      .add_option_function<std::string>(
          kSoftness,
          [&options](const std::string& text) {
            const std::optional<double> softness_m = softness_from_text(text);
            if (!softness_m) {
              throw CLI::ValidationError(
                  kSoftness,
                  fmt::format("expected metres from 0 to {}, found '{}'", kSoftest_m, text));
            }
            options.corrector.settle.softness_m = *softness_m;
          },
          "of the object: the skin sinks in by up to so much, as 0.005 or 5mm (method nade; "
          "default "
          "0)")
      ->type_name("M");
  command
      .add_option(kFriction, options.corrector.settle.friction.coefficient,
                  "to be seen: the hand lags along the surface by up to so many times the pressing "
                  "depth, then slips (method nade; default 0)")
      ->type_name("MU")
      ->check(number_in(0.0, 2.0));
  CLI::Option* const literal = command.add_flag("--paper-literal", options.literal,
                                                "every open point as the paper's text has it");
  literal->group(kGroup);
  add_open_points(command, options.corrector);
  for (CLI::Option* option : command.get_options()) {
    if (option != literal && option->get_group() == kGroup) literal->excludes(option);
  }
}

Status check_method(const MethodOptions& options, MethodChange change) {
  const Method asked = options.corrector.method;
  if (options.literal && options.command->count(kMethod) > 0 && asked != Method::paper) {
    return misuse("--paper-literal: only with --method paper");
  }
  if (change == MethodChange::any_time && !options.literal) return ok_status();
  for (const CLI::Option* option : options.command->get_options()) {
    const std::optional<Method> method = method_of(*option);
    if (option->count() == 0 || !method) continue;
    if (*method == (options.literal ? Method::paper : asked)) continue;
    return misuse(fmt::format("{}: only with --method {}", option->get_name(), name_of(*method)));
  }
  return ok_status();
}

std::optional<std::string> given_of(const MethodOptions& options) {
  if (options.command == nullptr) return std::nullopt;
  for (const CLI::Option* option : options.command->get_options()) {
    const std::string name = option->get_name();
    const bool says_how = name == kMethod || (name != kSoftness && method_of(*option));
    if (says_how && option->count() > 0) return name;
  }
  return std::nullopt;
}

CorrectorOptions options_of(const MethodOptions& options) {
  return options.literal ? paper_literal() : options.corrector;
}

std::string method_names() { return names_of(methods()); }

std::string method_name(const MethodOptions& options) {
  if (options.literal) return "paper_literal";
  return std::string(name_of(options.corrector.method));
}

}  // namespace nade::cli
