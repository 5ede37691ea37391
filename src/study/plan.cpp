#include "nade/study/plan.h"

#include <algorithm>

namespace nade::study {
namespace {

constexpr std::uint64_t kDefaultSeed = 2023;
constexpr std::size_t kIdentifierMax = 40;

std::vector<Text> default_instructions() {
  return {
      {"You will see an object and your own hands. Stroke the object with the palm and the fingers "
       "of one hand, the way you would stroke a real one, slowly, over its whole surface.",
       "物体と自分の手が見えます。実物を撫でるように、片手の手のひらと指で、物体の表面全体をゆっく"
       "り"
       "撫でてください。"},
      {"Nothing will hold your hand back: there is no real object. Go on stroking until the time "
       "is "
       "up, then answer the questions with the buttons of this panel.",
       "実際の物体はないので、手が止められることはありません。時間が終わるまで撫で続け、その後、こ"
       "のパネルのボタンで質問に答えてください。"},
      {"There are no right or wrong answers. You may stop at any time without giving a reason.",
       "正しい答えや間違った答えはありません。いつでも理由なく中止できます。"},
  };
}

/// Q1 to Q3 as the paper prints them (its section 3.1); the English is ours.
std::vector<Question> default_questions() {
  return {
      {"Q1",
       {"From what you saw, did you feel that your own hand and fingers were touching the object?",
        "映像から自分の手指が物体に接していると感じられましたか?"}},
      {"Q2",
       {"From what you saw, did you feel that you were moving your own hand and fingers?",
        "映像から自分の手指を動かしているように感じられましたか?"}},
      {"Q3",
       {"From what you saw, did you feel that you were stroking the object with your own hand and "
        "fingers?",
        "映像から自分の手指で物体を撫でているように感じられましたか?"}},
  };
}

}  // namespace

const std::string& Text::in(Language language) const {
  const bool wants_japanese = language == Language::japanese;
  if (wants_japanese) return japanese.empty() ? english : japanese;
  return english.empty() ? japanese : english;
}

Plan default_plan(Method corrected) {
  Plan plan;
  plan.title = "Stroking with and without correction";
  plan.seed = kDefaultSeed;
  plan.objects = {{"plane", "plane"}, {"sphere", "sphere"}, {"dog", "dog"}};
  plan.methods = {Method::none, corrected};
  plan.practice = Practice{"plane", Method::none, 20.0};
  plan.rest = Rest{};
  plan.questions = default_questions();
  plan.scale = {7, {"not at all", "全く感じなかった"}, {"very much", "非常に感じた"}};
  plan.instructions = default_instructions();
  plan.thanks = {"That was all. Thank you very much for taking part!",
                 "以上で終わりです。ご協力ありがとうございました。"};
  return plan;
}

std::vector<Trial> trials_of(const Plan& plan, std::string_view participant) {
  const std::size_t methods = plan.methods.size();
  std::vector<Trial> trials;
  for (const std::size_t condition :
       order_of(plan.order, plan.objects.size() * methods, plan.seed, participant)) {
    trials.push_back({trials.size() + 1, plan.objects[condition / methods].name,
                      plan.methods[condition % methods]});
  }
  return trials;
}

const StudyObject* find_object(const Plan& plan, std::string_view name) {
  const auto found = std::find_if(plan.objects.begin(), plan.objects.end(),
                                  [&](const StudyObject& object) { return object.name == name; });
  return found == plan.objects.end() ? nullptr : &*found;
}

bool is_identifier(std::string_view text) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  return !text.empty() && text.size() <= kIdentifierMax &&
         text.find_first_not_of(kLetters) == std::string_view::npos;
}

}  // namespace nade::study
