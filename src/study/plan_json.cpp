#include "plan_json.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <limits>
#include <set>

#include "nade/study/plan.h"

namespace nade::study {
namespace {

constexpr std::string_view kPlanFormat = "nade-study-plan";
constexpr int kPlanVersion = 1;
constexpr double kLongestTrial_s = 3600.0;
constexpr std::size_t kConditionsMax = 99;

Text text_from(const JsonReader& json) {
  json.allow({"en", "ja"});
  Text text;
  if (json.has("en")) text.english = json.at("en").text();
  if (json.has("ja")) text.japanese = json.at("ja").text();
  if (text.english.empty() && text.japanese.empty()) json.refuse("a text under \"en\" or \"ja\"");
  return text;
}

Json json_of(const Text& text) {
  Json json = Json::object();
  if (!text.english.empty()) json["en"] = text.english;
  if (!text.japanese.empty()) json["ja"] = text.japanese;
  return json;
}

Method method_from(const JsonReader& json) {
  const auto method =
      json.is_text() ? method_from_name(json.json().get<std::string>()) : std::nullopt;
  if (!method) json.refuse("\"none\", \"paper\" or \"nade\"");
  return method.value_or(Method::none);
}

StudyObject object_from(const JsonReader& json) {
  if (json.is_text()) {
    // Only the built-in ones are their own names.
    const std::string name = json.text();
    if (name != "plane" && name != "sphere" && name != "dog") {
      json.refuse("\"plane\", \"sphere\", \"dog\" or {\"name\": …, \"file\": …}");
    }
    return {name, name};
  }
  json.allow({"name", "file"});
  return {json.at("name").identifier(), json.at("file").text()};
}

Json json_of(const StudyObject& object) {
  if (object.name == object.spec) return object.name;
  return {{"name", object.name}, {"file", object.spec}};
}

void read_conditions(const JsonReader& json, Plan& plan) {
  const JsonReader objects = json.at("objects");
  std::set<std::string> names;
  for (std::size_t i = 0; i < objects.count(1); ++i) {
    plan.objects.push_back(object_from(objects.at(i)));
    if (!names.insert(plan.objects.back().name).second) objects.at(i).refuse("each object once");
  }
  const JsonReader methods = json.at("methods");
  std::set<Method> seen;
  for (std::size_t i = 0; i < methods.count(1); ++i) {
    plan.methods.push_back(method_from(methods.at(i)));
    if (!seen.insert(plan.methods.back()).second) methods.at(i).refuse("each method once");
  }
  if (plan.objects.size() * plan.methods.size() > kConditionsMax) {
    objects.refuse(fmt::format("at most {} objects times methods", kConditionsMax));
  }
}

void read_questions(const JsonReader& json, Plan& plan) {
  const JsonReader questions = json.at("questions");
  std::set<std::string> ids;
  for (std::size_t i = 0; i < questions.count(1); ++i) {
    const JsonReader question = questions.at(i);
    question.allow({"id", "text"});
    plan.questions.push_back({question.at("id").identifier(), text_from(question.at("text"))});
    if (!ids.insert(plan.questions.back().id).second) question.at("id").refuse("each id once");
  }
  const JsonReader scale = json.at("scale");
  scale.allow({"points", "low", "high"});
  plan.scale = {static_cast<int>(scale.at("points").whole(2, 11)), text_from(scale.at("low")),
                text_from(scale.at("high"))};
}

void read_practice(const JsonReader& json, Plan& plan) {
  if (!json.has("practice") || json.at("practice").json().is_null()) return;
  const JsonReader practice = json.at("practice");
  practice.allow({"object", "method", "duration_s"});
  plan.practice = Practice{practice.at("object").text(), method_from(practice.at("method")),
                           practice.at("duration_s").number(1.0, 600.0)};
  if (find_object(plan, plan.practice->object) == nullptr) {
    practice.at("object").refuse("the name of one of the plan's objects");
  }
}

void read_rest(const JsonReader& json, Plan& plan) {
  if (!json.has("rest") || json.at("rest").json().is_null()) return;
  const JsonReader rest = json.at("rest");
  rest.allow({"after_trials", "at_least_s"});
  plan.rest = Rest{static_cast<std::size_t>(rest.at("after_trials").whole(1, kConditionsMax)),
                   rest.at("at_least_s").number(0.0, kLongestTrial_s)};
}

void read_choices(const JsonReader& json, Plan& plan) {
  const std::string language = json.at("language").text();
  if (language == "ja") {
    plan.language = Language::japanese;
  } else if (language != "en") {
    json.at("language").refuse("\"en\" or \"ja\"");
  }
  const std::string order = json.at("order").text();
  if (order == "latin") {
    plan.order = OrderKind::latin;
  } else if (order != "random") {
    json.at("order").refuse("\"random\" or \"latin\"");
  }
}

}  // namespace

Plan plan_from(const JsonReader& json) {
  Plan plan;
  json.allow({"format", "version", "title", "seed", "language", "order", "objects", "methods",
              "trial_s", "countdown_s", "practice", "rest", "questions", "scale", "instructions",
              "thanks"});
  json.be(kPlanFormat, kPlanVersion);
  plan.title = json.at("title").text();
  plan.seed = json.at("seed").whole(0, std::numeric_limits<std::uint64_t>::max());
  read_choices(json, plan);
  read_conditions(json, plan);
  plan.trial_s = json.at("trial_s").number(1.0, kLongestTrial_s);
  plan.countdown_s = json.at("countdown_s").number(0.0, 60.0);
  read_practice(json, plan);
  read_rest(json, plan);
  read_questions(json, plan);
  const JsonReader instructions = json.at("instructions");
  for (std::size_t i = 0; i < instructions.count(0); ++i) {
    plan.instructions.push_back(text_from(instructions.at(i)));
  }
  plan.thanks = text_from(json.at("thanks"));
  return plan;
}

Json json_of(const Plan& plan) {
  Json json{{"format", kPlanFormat},
            {"version", kPlanVersion},
            {"title", plan.title},
            {"seed", plan.seed}};
  json["language"] = plan.language == Language::japanese ? "ja" : "en";
  json["order"] = plan.order == OrderKind::latin ? "latin" : "random";
  json["objects"] = Json::array();
  for (const StudyObject& object : plan.objects) json["objects"].push_back(json_of(object));
  json["methods"] = Json::array();
  for (const Method method : plan.methods) json["methods"].push_back(name_of(method));
  json["trial_s"] = plan.trial_s;
  json["countdown_s"] = plan.countdown_s;
  json["practice"] = nullptr;
  if (plan.practice) {
    json["practice"] = {{"object", plan.practice->object},
                        {"method", name_of(plan.practice->method)},
                        {"duration_s", plan.practice->duration_s}};
  }
  json["rest"] = nullptr;
  if (plan.rest) {
    json["rest"] = {{"after_trials", plan.rest->after_trials},
                    {"at_least_s", plan.rest->at_least_s}};
  }
  json["questions"] = Json::array();
  for (const Question& question : plan.questions) {
    json["questions"].push_back({{"id", question.id}, {"text", json_of(question.text)}});
  }
  json["scale"] = {{"points", plan.scale.points},
                   {"low", json_of(plan.scale.low)},
                   {"high", json_of(plan.scale.high)}};
  json["instructions"] = Json::array();
  for (const Text& paragraph : plan.instructions)
    json["instructions"].push_back(json_of(paragraph));
  json["thanks"] = json_of(plan.thanks);
  return json;
}

Result<Plan> parse_plan(std::string_view text, const std::string& name) {
  const Result<Json> json = parse_json(text, name);
  if (!json) return json.error();
  std::optional<Error> error;
  Plan plan = plan_from(JsonReader(*json, name, error));
  if (error) return *error;
  return plan;
}

Result<Plan> read_plan(const std::string& path) {
  const Result<std::string> text = read_text(path, "a study's plan");
  if (!text) return text.error();
  return parse_plan(*text, path);
}

std::string plan_text(const Plan& plan) { return json_of(plan).dump(2) + "\n"; }

std::string difference_of(const Plan& a, const Plan& b) {
  const Json one = json_of(a);
  const Json other = json_of(b);
  for (const auto& [key, value] : one.items()) {
    if (other.at(key) != value) return key;
  }
  return {};
}

}  // namespace nade::study
