#include "nade/eval/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace nade {
namespace {

constexpr double kRate_hz = 90.0;

std::vector<Vec3> palm_shifts(NoiseModel model, std::uint64_t seed, std::size_t frames) {
  TrackerNoise noise(model, seed);
  std::vector<Vec3> shifts;
  for (std::size_t i = 0; i < frames; ++i) {
    shifts.push_back(noise.next(static_cast<double>(i) / kRate_hz).palm.position);
  }
  return shifts;
}

double rms(const std::vector<Vec3>& values) {
  double sum = 0.0;
  for (const Vec3& value : values) sum += value.squaredNorm();
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<Vec3> steps(const std::vector<Vec3>& values) {
  std::vector<Vec3> result;
  for (std::size_t i = 1; i < values.size(); ++i) result.push_back(values[i] - values[i - 1]);
  return result;
}

TEST(Random, SequenceIsTheSameOnEveryMachine) {
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317u);
  EXPECT_EQ(random.next(), 3203168211198807973u);
  EXPECT_EQ(random.next(), 9817491932198370423u);
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
  Random random(1);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.01);
  EXPECT_NEAR(squares / kCount, 1.0, 0.02);
}

TEST(Noise, NoneIsExact) {
  TrackerNoise noise(NoiseModel::none, 7);
  const TrackerError error = noise.next(1.0);
  EXPECT_EQ(error.palm.position, Vec3::Zero());
  EXPECT_EQ(error.palm.rotation.coeffs(), Quat::Identity().coeffs());
  EXPECT_EQ(error.angles[1][0].flexion, 0.0);
}

TEST(Noise, SameSeedSameErrors) {
  EXPECT_EQ(palm_shifts(NoiseModel::quest, 5, 50), palm_shifts(NoiseModel::quest, 5, 50));
  EXPECT_NE(palm_shifts(NoiseModel::quest, 5, 50), palm_shifts(NoiseModel::quest, 6, 50));
}

TEST(Noise, QuestErrsByAMillimetreOrTwo) {
  const auto shifts = palm_shifts(NoiseModel::quest, 3, 9'000);
  EXPECT_GT(rms(shifts), 0.8e-3);
  EXPECT_LT(rms(shifts), 2.0e-3);
  // From frame to frame about half a millimetre.
  EXPECT_GT(rms(steps(shifts)), 0.3e-3);
  EXPECT_LT(rms(steps(shifts)), 0.8e-3);
}

TEST(Noise, LeapDriftsFarAndShakesLittle) {
  const auto shifts = palm_shifts(NoiseModel::leap, 3, 9'000);
  EXPECT_GT(rms(shifts), 5.0e-3);
  EXPECT_LT(rms(shifts), 10.0e-3);
  EXPECT_LT(rms(steps(shifts)), 0.5e-3);
}

TEST(Noise, NamesGoBothWays) {
  for (const NoiseModel model : {NoiseModel::none, NoiseModel::quest, NoiseModel::leap}) {
    EXPECT_EQ(noise_from_name(name_of(model)), model);
  }
  EXPECT_FALSE(noise_from_name("vive").has_value());
}

}  // namespace
}  // namespace nade
