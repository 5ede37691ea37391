#include "remote_hands.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <utility>

namespace nade::test {
namespace {

// What the driver reads, byte for byte, as Monado 25 has it: little-endian, floats, each part
// padded to the next.
struct WirePose {
  std::array<float, 4> turn{0.0F, 0.0F, 0.0F, 1.0F};  // x, y, z, w
  std::array<float, 3> place{};
};
struct WireView {
  std::array<float, 4> angles{};  // left, right, up, down
  WirePose pose;
  std::uint32_t padding = 0;
};
struct WireHand {
  WirePose grip;
  std::array<float, 6> velocities{};
  std::array<float, 5> curl{};
  std::array<float, 8> controls{};  // trigger, squeeze, stick, pad
  std::uint8_t tracked = 0;
  std::uint8_t active = 0;
  std::array<std::uint8_t, 14> buttons{};
};
struct WireState {
  std::array<char, 8> format{'m', 'n', 'd', 'r', 'm', 't', '3', '\0'};
  std::array<WireView, 2> views{};
  WirePose head;
  std::array<std::uint8_t, 4> views_valid{1, 0, 0, 0};
  std::array<WireHand, 2> hands{};
};
static_assert(sizeof(WireView) == 48);
static_assert(sizeof(WireHand) == 120);
static_assert(sizeof(WireState) == 376);

/// The driver's right hand, seen from its wrist: the palm's joint, the stretched index's tip.
const Vec3 kPalm(-0.003291, 0.000950, -0.064432);
const Vec3 kIndexTip(-0.043003, 0.0, -0.168687);

Vec3 sided(Handedness side, const Vec3& right) {
  return side == Handedness::right ? right : Vec3(-right.x(), right.y(), right.z());
}

WirePose wire(const Pose& pose) {
  const Eigen::Vector4f q = pose.rotation.coeffs().cast<float>();
  const Eigen::Vector3f p = pose.position.cast<float>();
  return {{q.x(), q.y(), q.z(), q.w()}, {p.x(), p.y(), p.z()}};
}

WireHand wire(const RemoteHand& hand) {
  WireHand result;
  result.grip = wire(hand.grip);
  // From the little finger to the thumb.
  std::copy(hand.curl.rbegin(), hand.curl.rend(), result.curl.begin());
  result.tracked = hand.tracked ? 1 : 0;
  result.active = hand.tracked ? 1 : 0;
  return result;
}

WireState wire(const RemoteState& state) {
  WireState result;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    const draw::FieldOfView& view = state.views[eye];
    result.views[eye].angles = {static_cast<float>(view.left), static_cast<float>(view.right),
                                static_cast<float>(view.up), static_cast<float>(view.down)};
    result.views[eye].pose = wire(state.eyes[eye]);
  }
  result.head = wire(state.head);
  for (std::size_t side = 0; side < 2; ++side) result.hands[side] = wire(state.hands[side]);
  return result;
}

}  // namespace

RemoteDriver::RemoteDriver(RemoteDriver&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)) {}
RemoteDriver& RemoteDriver::operator=(RemoteDriver&& other) noexcept {
  std::swap(socket_, other.socket_);
  return *this;
}
RemoteDriver::~RemoteDriver() {
  if (socket_ >= 0) close(socket_);
}

Result<RemoteDriver> RemoteDriver::connect(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int attempt = 0; attempt < 100; ++attempt) {
    RemoteDriver driver(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const auto* const to = reinterpret_cast<const sockaddr*>(&address);
    if (driver.socket_ >= 0 && ::connect(driver.socket_, to, sizeof address) == 0) {
      const int at_once = 1;
      setsockopt(driver.socket_, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
      return driver;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return Error{ErrorCode::not_found,
               "no Monado service with a remote driver answers on port " + std::to_string(port)};
}

bool RemoteDriver::send(const RemoteState& state) {
  const WireState bytes = wire(state);
  const char* at = reinterpret_cast<const char*>(&bytes);
  std::size_t left = sizeof bytes;
  while (left > 0) {
    const ssize_t sent = ::send(socket_, at, left, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    at += sent;
    left -= static_cast<std::size_t>(sent);
  }
  return true;
}

RemoteState looking_down() {
  RemoteState state;
  state.head.position = Vec3(0.0, 1.6, 0.0);
  state.head.rotation = Quat(Eigen::AngleAxisd(-0.6, Vec3::UnitX()));
  state.views[0] = {-0.85, 0.70, 0.75, -0.80};
  state.views[1] = {-0.70, 0.85, 0.75, -0.80};
  state.eyes[0].position = Vec3(-0.0315, 0.0, 0.0);
  state.eyes[1].position = Vec3(0.0315, 0.0, 0.0);
  return state;
}

Pose grip_for_palm(Handedness side, const Pose& palm) {
  return {palm.apply(-sided(side, kPalm)), palm.rotation};
}

RemoteHand pointing(Handedness side, const Vec3& tip, const Quat& turn) {
  RemoteHand hand;
  hand.tracked = true;
  hand.grip = {tip - turn * sided(side, kIndexTip), turn};
  hand.curl = {0.6F, 0.0F, 1.0F, 1.0F, 1.0F};
  return hand;
}

}  // namespace nade::test
