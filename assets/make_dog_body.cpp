#include "make_dog_body.h"

#include <cmath>
#include <utility>

// Proportions after: Fédération Cynologique Internationale. Standard 122, Labrador Retriever. 2022.
// (head and eyes a little larger than life)

namespace dog {
namespace {

constexpr double kTrunkEdge = 0.0070;
constexpr double kLegEdge = 0.0048;
constexpr double kPawEdge = 0.0034;
constexpr double kHeadEdge = 0.0040;
constexpr double kEarEdge = 0.0024;
constexpr double kEyeEdge = 0.0014;
constexpr double kNoseEdge = 0.0018;
constexpr double kMouthEdge = 0.0018;

const Vec3 kForward = -Vec3::UnitX();
const Vec3 kUp = Vec3::UnitY();
const Vec3 kLeft = Vec3::UnitZ();

/// Which side of the body: `sign` is +1 on the left (+Z), -1 on the right.
struct Side {
  std::string name;
  double sign;
};
const Side kSides[] = {{"left", 1.0}, {"right", -1.0}};

/// Where the head's own coordinates lie: origin amid the skull, nose toward -X.
struct HeadFrame {
  Vec3 origin{-0.255, 0.540, 0.0};
  double scale = 1.06;
  double pitch = 0.16;  ///< nose down, radians

  [[nodiscard]] Eigen::Quaterniond rotation() const {
    return Eigen::Quaterniond(Eigen::AngleAxisd(pitch, Vec3::UnitZ()));
  }
  [[nodiscard]] Vec3 point(const Vec3& local) const {
    return origin + rotation() * (scale * local);
  }

  [[nodiscard]] Shape tube(std::vector<Station> stations, const Vec3& side, double cap,
                           double blend, double power = 2.0) const {
    for (Station& s : stations) {
      s.center = point(s.center);
      s.half_width *= scale;
      s.half_height *= scale;
    }
    return {Tube(stations, rotation() * side, scale * cap, power), scale * blend};
  }
  [[nodiscard]] Shape ellipsoid(
      const Vec3& center, const Vec3& radii, double blend,
      const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) const {
    return {Ellipsoid{point(center), scale * radii, rotation() * turn}, scale * blend};
  }
};

Shape tube(const std::vector<Station>& stations, const Vec3& side, double cap, double blend,
           double power = 2.0) {
  return {Tube(stations, side, cap, power), blend};
}

Vec3 mirrored(const Side& side, double x, double y, double z) { return {x, y, side.sign * z}; }

Part make_torso() {
  Part part{"torso", {}, 0.05, kTrunkEdge};
  // Deep chest, ribs widest a little above the middle, loin tucked up.
  part.shapes.push_back(tube({{{-0.186, 0.332, 0}, 0.056, 0.076},
                              {{-0.150, 0.332, 0}, 0.070, 0.100},
                              {{-0.090, 0.332, 0}, 0.078, 0.113, 0.05},
                              {{-0.020, 0.336, 0}, 0.083, 0.106, 0.05},
                              {{0.060, 0.350, 0}, 0.077, 0.090},
                              {{0.130, 0.359, 0}, 0.067, 0.078},
                              {{0.185, 0.358, 0}, 0.064, 0.074},
                              {{0.215, 0.350, 0}, 0.058, 0.066}},
                             kLeft, 0.045, 0.04, 2.25));
  // Breastbone.
  part.shapes.push_back({Ellipsoid{{-0.188, 0.322, 0}, {0.045, 0.066, 0.046}}, 0.05});
  return part;
}

Part make_neck() {
  Part part{"neck", {}, 0.06, kTrunkEdge};
  part.shapes.push_back(tube({{{-0.130, 0.370, 0}, 0.058, 0.078},
                              {{-0.170, 0.420, 0}, 0.057, 0.076},
                              {{-0.200, 0.470, 0}, 0.054, 0.066},
                              {{-0.225, 0.512, 0}, 0.047, 0.051}},
                             kLeft, 0.035, 0.04));
  return part;
}

Part make_skull(const HeadFrame& head) {
  Part part{"head", {}, 0.060, kHeadEdge};
  part.shapes.push_back(head.tube({{{0.030, -0.006, 0}, 0.043, 0.038},
                                   {{0.008, 0.003, 0}, 0.051, 0.046},
                                   {{-0.022, 0.004, 0}, 0.050, 0.045},
                                   {{-0.052, -0.006, 0}, 0.038, 0.034}},
                                  kLeft, 0.022, 0.02, 2.2));
  for (const Side& side : kSides) {
    // Cheek and brow.
    part.shapes.push_back(
        head.ellipsoid(mirrored(side, -0.012, -0.020, 0.028), {0.038, 0.030, 0.023}, 0.03));
    part.shapes.push_back(
        head.ellipsoid(mirrored(side, -0.050, 0.024, 0.022), {0.016, 0.011, 0.015}, 0.022));
  }
  return part;
}

Part make_muzzle(const HeadFrame& head) {
  Part part{"muzzle", {}, 0.028, kHeadEdge};
  part.shapes.push_back(head.tube({{{-0.040, -0.018, 0}, 0.036, 0.031},
                                   {{-0.072, -0.017, 0}, 0.0305, 0.0270, -0.08},
                                   {{-0.105, -0.018, 0}, 0.0285, 0.0250, -0.08},
                                   {{-0.126, -0.019, 0}, 0.0235, 0.0230, -0.08}},
                                  kLeft, 0.013, 0.02, 2.4));
  // Lower jaw and chin.
  part.shapes.push_back(head.tube({{{-0.030, -0.040, 0}, 0.028, 0.018},
                                   {{-0.075, -0.046, 0}, 0.0220, 0.0135},
                                   {{-0.110, -0.0455, 0}, 0.0175, 0.0110}},
                                  kLeft, 0.011, 0.012));
  for (const Side& side : kSides)  // lips
    part.shapes.push_back(
        head.ellipsoid(mirrored(side, -0.095, -0.029, 0.0145), {0.036, 0.0185, 0.0160}, 0.016));
  return part;
}

Part make_nose(const HeadFrame& head) {
  Part part{"nose", {}, 0.006, kNoseEdge};
  part.shapes.push_back(head.ellipsoid({-0.1320, -0.0060, 0}, {0.0100, 0.0120, 0.0155}, 0.008));
  for (const Side& side : kSides)
    part.shapes.push_back(
        head.ellipsoid(mirrored(side, -0.1325, -0.0060, 0.0095), {0.0090, 0.0090, 0.0080}, 0.006));
  return part;
}

Part make_eye(const HeadFrame& head, const Side& side) {
  Part part{side.name + " eye", {}, 0.0025, kEyeEdge};
  part.shapes.push_back(
      head.ellipsoid(mirrored(side, -0.0625, 0.0105, 0.0275), Vec3::Constant(0.0105), 0.001));
  return part;
}

Part make_ear(const HeadFrame& head, const Side& side) {
  Part part{side.name + " ear", {}, 0.046, kEarEdge};
  // A soft flap: folds over at the root, widest in the middle, rounded tip; hangs close to the
  // cheek, since a gap that the joint half fills ends in a groove too sharp for these triangles.
  part.shapes.push_back(head.tube({{mirrored(side, 0.018, 0.024, 0.030), 0.020, 0.0120},
                                   {mirrored(side, 0.016, 0.028, 0.052), 0.024, 0.0095},
                                   {mirrored(side, 0.010, 0.013, 0.0705), 0.0280, 0.0078},
                                   {mirrored(side, 0.001, -0.014, 0.0720), 0.0270, 0.0070},
                                   {mirrored(side, -0.008, -0.040, 0.0655), 0.0175, 0.0064}},
                                  Vec3::UnitX(), 0.020, 0.01, 2.2));
  return part;
}

Part make_paw(const Side& side, const std::string& limb, double x, double z) {
  Part part{side.name + " " + limb + " paw", {}, 0.020, kPawEdge};
  part.shapes.push_back({Ellipsoid{mirrored(side, x, 0.0235, z), {0.033, 0.0225, 0.0255}}, 0.022});
  const double toes[][3] = {{-0.0190, 0.0160, -0.0180},
                            {-0.0275, 0.0180, -0.0064},
                            {-0.0275, 0.0180, 0.0064},
                            {-0.0190, 0.0160, 0.0180}};
  for (const auto& toe : toes)
    part.shapes.push_back(
        {Ellipsoid{mirrored(side, x + toe[0], toe[1], z + toe[2]), {0.0185, 0.0155, 0.0086}},
         0.008});
  return part;
}

Part make_fore_leg(const Side& side) {
  Part part{side.name + " fore leg", {}, 0.055, kLegEdge};
  const auto at = [&](double x, double y, double z) { return mirrored(side, x, y, z); };
  // Shoulder blade to elbow lies in the chest wall; forearm, wrist and pastern are free.
  part.shapes.push_back(tube({{at(-0.120, 0.400, 0.040), 0.045, 0.028},
                              {at(-0.176, 0.322, 0.050), 0.046, 0.030},
                              {at(-0.140, 0.245, 0.055), 0.038, 0.027}},
                             kForward, 0.03, 0.04));
  part.shapes.push_back(tube({{at(-0.139, 0.250, 0.055), 0.034, 0.025},
                              {at(-0.139, 0.215, 0.056), 0.0325, 0.0255},
                              {at(-0.143, 0.160, 0.055), 0.0250, 0.0220},
                              {at(-0.145, 0.105, 0.054), 0.0218, 0.0205},
                              {at(-0.148, 0.070, 0.054), 0.0195, 0.0198},
                              {at(-0.156, 0.030, 0.054), 0.0200, 0.0210}},
                             kForward, 0.015, 0.04));
  return part;
}

Part make_hind_leg(const Side& side) {
  Part part{side.name + " hind leg", {}, 0.055, kLegEdge};
  const auto at = [&](double x, double y, double z) { return mirrored(side, x, y, z); };
  // Thigh and shin.
  part.shapes.push_back(tube({{at(0.178, 0.375, 0.030), 0.048, 0.030},
                              {at(0.172, 0.310, 0.047), 0.062, 0.035},
                              {at(0.163, 0.245, 0.056), 0.050, 0.031},
                              {at(0.188, 0.182, 0.057), 0.031, 0.0240},
                              {at(0.221, 0.130, 0.056), 0.0200, 0.0180}},
                             kForward, 0.024, 0.04));
  // Hock to paw, the heel bone standing out behind.
  part.shapes.push_back(tube({{at(0.2335, 0.142, 0.056), 0.0135, 0.0130},
                              {at(0.2285, 0.116, 0.056), 0.0185, 0.0168},
                              {at(0.2265, 0.070, 0.056), 0.0165, 0.0172},
                              {at(0.220, 0.030, 0.056), 0.0195, 0.0200}},
                             kForward, 0.010, 0.032));
  return part;
}

Part make_tail() {
  Part part{"tail", {}, 0.035, kLegEdge};
  part.shapes.push_back(tube({{{0.215, 0.395, 0}, 0.026, 0.027},
                              {{0.262, 0.390, 0}, 0.0235, 0.0240},
                              {{0.318, 0.378, 0}, 0.0195, 0.0200},
                              {{0.370, 0.386, 0}, 0.0150, 0.0155},
                              {{0.412, 0.412, 0}, 0.0095, 0.0100}},
                             kLeft, 0.012, 0.03));
  return part;
}

Furrow make_mouth(const HeadFrame& head, const Side& side) {
  const auto at = [&](double x, double y, double z) {
    return Station{head.point(mirrored(side, x, y, z)), 0.002, 0.002};
  };
  return {side.name + " mouth",
          Tube(std::vector<Station>{at(-0.138, -0.022, 0.000), at(-0.128, -0.0405, 0.014),
                                    at(-0.105, -0.0425, 0.0245), at(-0.080, -0.0415, 0.0285),
                                    at(-0.064, -0.036, 0.0275), at(-0.050, -0.031, 0.0180)},
               kUp, 0.002),
          0.0016, 0.0028, kMouthEdge};
}

}  // namespace

Body make_body() {
  const HeadFrame head;
  Body body;
  body.add(make_torso());
  body.add(make_neck());
  body.add(make_skull(head));
  body.add(make_muzzle(head));
  body.add(make_nose(head));
  body.add(make_tail());
  for (const Side& side : kSides) {
    body.add(make_eye(head, side));
    body.add(make_ear(head, side));
    body.add(make_fore_leg(side));
    body.add(make_paw(side, "fore", -0.164, 0.054));
    body.add(make_hind_leg(side));
    body.add(make_paw(side, "hind", 0.212, 0.056));
  }
  for (const Side& side : kSides) body.add(make_mouth(head, side));
  return body;
}

}  // namespace dog
