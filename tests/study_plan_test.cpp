#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "nade/study/plan.h"

namespace nade::study {
namespace {

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

std::string person(std::size_t number) { return std::string("P").append(std::to_string(number)); }

std::string error_of(const std::string& text) {
  const Result<Plan> plan = parse_plan(text, "plan.json");
  return plan.ok() ? "" : plan.error().message;
}

TEST(StudyPlan, DefaultIsThePapersExperiment) {
  const Plan plan = default_plan();
  ASSERT_EQ(plan.objects.size(), 3u);
  EXPECT_EQ(plan.objects[2].name, "dog");
  EXPECT_EQ(plan.methods, (std::vector{Method::none, Method::paper}));
  EXPECT_EQ(plan.trial_s, 30.0);
  EXPECT_EQ(plan.questions.size(), 3u);
  EXPECT_EQ(plan.scale.points, 7);
  EXPECT_EQ(plan.order, OrderKind::random);
  EXPECT_EQ(default_plan(Method::nade).methods[1], Method::nade);
}

TEST(StudyPlan, ComesBackFromItsText) {
  Plan plan = default_plan();
  plan.objects.push_back({"cat", "meshes/cat.glb"});
  plan.language = Language::japanese;
  plan.order = OrderKind::latin;
  plan.seed = 0xffff'ffff'ffff'ffffULL;
  plan.practice.reset();
  plan.rest.reset();
  const Result<Plan> back = parse_plan(plan_text(plan), "plan.json");
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(*back, plan);
  EXPECT_EQ(difference_of(*back, plan), "");
  plan.trial_s = 31.0;
  EXPECT_EQ(difference_of(*back, plan), "trial_s");
}

TEST(StudyPlan, ErrorsNameThePlace) {
  const std::string good = plan_text(default_plan());
  EXPECT_EQ(error_of(replaced(good, "\"trial_s\": 30.0", "\"trial_s\": \"long\"")),
            "plan.json: trial_s: expected a number from 1 to 3600, found \"long\"");
  EXPECT_EQ(error_of(replaced(good, "\"none\",", "\"noone\",")),
            "plan.json: methods[0]: expected \"none\", \"paper\" or \"nade\", found \"noone\"");
  EXPECT_EQ(error_of(replaced(good, "\"Q2\"", "\"Q1\"")),
            "plan.json: questions[1].id: expected each id once, found \"Q1\"");
  EXPECT_EQ(error_of(replaced(good, "\"points\": 7", "\"points\": 7.5")),
            "plan.json: scale.points: expected a whole number from 2 to 11, found 7.5");
  EXPECT_EQ(error_of(replaced(good, "\"after_trials\"", "\"aftertrials\"")),
            "plan.json: rest: expected only after_trials, at_least_s, found \"aftertrials\"");
  EXPECT_EQ(error_of(replaced(good, "nade-study-plan", "something")),
            "plan.json: format: expected \"nade-study-plan\", found \"something\"");
  EXPECT_EQ(error_of("{\n\"format\": nade\n}"), "plan.json: line 2: expected valid JSON");
  EXPECT_EQ(error_of(replaced(good, "\"trial_s\": 30.0", "\"trial_s\": 1e999"))
                .rfind("plan.json: line ", 0),
            0u);
  EXPECT_EQ(error_of("{\n\"seed\": \"1e999\",\n\"a\": -1e999}"),
            "plan.json: line 3: expected numbers that a double can hold, found a larger one");
  EXPECT_EQ(error_of(std::string(100000, '[')),
            "plan.json: expected values nested at most 64 deep, found more");
  EXPECT_EQ(error_of("[]"), "plan.json: expected an object, found an array of 0");
  EXPECT_EQ(read_plan("/nowhere/plan.json").error().message,
            "/nowhere/plan.json: expected a study's plan, found no such file");
}

TEST(StudyPlan, NamesOfParticipantsTellNothing) {
  EXPECT_TRUE(is_identifier("P01"));
  EXPECT_TRUE(is_identifier("a-b_C"));
  EXPECT_FALSE(is_identifier(""));
  EXPECT_FALSE(is_identifier("Ann Smith"));
  EXPECT_FALSE(is_identifier("../P01"));
  EXPECT_FALSE(is_identifier("山田"));
}

TEST(StudyOrder, IsTheSameForEver) {
  EXPECT_EQ(order_of(OrderKind::random, 6, 2023, "P01"),
            (std::vector<std::size_t>{5, 0, 1, 4, 3, 2}));
  EXPECT_EQ(order_of(OrderKind::latin, 6, 2023, "P01"),
            (std::vector<std::size_t>{3, 1, 2, 0, 5, 4}));
  EXPECT_EQ(seed_of(2023, "P01"), 4769349866455074194u);
  EXPECT_NE(seed_of(2023, "P01"), seed_of(2024, "P01"));
  EXPECT_NE(seed_of(2023, "P01"), seed_of(2023, "P10"));
}

TEST(StudyOrder, RandomPutsEachConditionInEachPlaceAsOften) {
  std::map<std::pair<std::size_t, std::size_t>, int> count;
  constexpr std::size_t kPeople = 6000;
  for (std::size_t i = 0; i < kPeople; ++i) {
    const auto order = order_of(OrderKind::random, 6, 7, person(i));
    EXPECT_EQ(std::set(order.begin(), order.end()).size(), 6u);
    for (std::size_t place = 0; place < 6; ++place) ++count[{place, order[place]}];
  }
  for (const auto& [key, times] : count)
    EXPECT_NEAR(times, static_cast<double>(kPeople) / 6.0, 150.0);
}

TEST(StudyOrder, LatinSquareIsBalanced) {
  for (const std::size_t count : {2u, 4u, 5u, 6u, 7u}) {
    const std::size_t rows = count % 2 == 0 ? count : 2 * count;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> placed;
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> follows;
    for (std::size_t row = 0; row < rows; ++row) {
      const auto order = order_of(OrderKind::latin, count, 11, person(row + 1));
      ASSERT_EQ(std::set(order.begin(), order.end()).size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        ++placed[{i, order[i]}];
        if (i > 0) ++follows[{order[i - 1], order[i]}];
      }
    }
    EXPECT_EQ(placed.size(), count * count);
    EXPECT_EQ(follows.size(), count * (count - 1));
    for (const auto& [key, times] : placed) EXPECT_EQ(times, rows / count);
    for (const auto& [key, times] : follows) EXPECT_EQ(times, rows / count);
  }
}

}  // namespace
}  // namespace nade::study
