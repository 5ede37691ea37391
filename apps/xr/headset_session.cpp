#include "headset_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "nade/openxr.h"

// Based on: The Khronos Group. The OpenXR Specification, version 1.0. Chapters 7, 9, 10, and
// XR_EXT_hand_tracking.

namespace nade::xr {
namespace {

/// Above the floor, of eyes in a space that does not tell where the floor is.
constexpr double kSeatedEyes_m = 1.2;
constexpr std::int64_t kColorFormat = GL_SRGB8_ALPHA8;

Error refused(const char* what, XrResult result) {
  return {ErrorCode::not_found,
          fmt::format("the OpenXR runtime refused {}: {}", what, name_of(result))};
}

draw::FieldOfView view_from(const XrFovf& view) {
  return {view.angleLeft, view.angleRight, view.angleUp, view.angleDown};
}

}  // namespace

Result<EyePictures> EyePictures::create(const XrApi& api, XrSession session, const EyeSize& size) {
  XrSwapchainCreateInfo create{};
  create.type = XR_TYPE_SWAPCHAIN_CREATE_INFO;
  create.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_TRANSFER_DST_BIT;
  create.format = kColorFormat;
  create.sampleCount = 1;
  create.width = static_cast<std::uint32_t>(size.width);
  create.height = static_cast<std::uint32_t>(size.height);
  create.faceCount = 1;
  create.arraySize = 1;
  create.mipCount = 1;
  XrSwapchain swapchain = XR_NULL_HANDLE;
  XrResult result = api.xrCreateSwapchain(session, &create, &swapchain);
  if (XR_FAILED(result)) return refused("pictures for the eyes (xrCreateSwapchain)", result);
  EyePictures pictures;
  pictures.swapchain_ = {swapchain, api.xrDestroySwapchain};
  pictures.size_ = size;
  std::uint32_t count = 0;
  result = api.xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr);
  std::vector<XrSwapchainImageOpenGLKHR> images(count,
                                                {XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_KHR, nullptr, 0});
  if (XR_SUCCEEDED(result)) {
    result = api.xrEnumerateSwapchainImages(
        swapchain, count, &count, reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data()));
  }
  if (XR_FAILED(result))
    return refused("pictures for the eyes (xrEnumerateSwapchainImages)", result);
  for (const XrSwapchainImageOpenGLKHR& image : images) {
    Framebuffer& framebuffer = pictures.framebuffers_.emplace_back();
    glCreateFramebuffers(1, &framebuffer.name);
    glNamedFramebufferTexture(framebuffer.name, GL_COLOR_ATTACHMENT0, image.image, 0);
    if (glCheckNamedFramebufferStatus(framebuffer.name, GL_DRAW_FRAMEBUFFER) !=
        GL_FRAMEBUFFER_COMPLETE) {
      return Error{ErrorCode::bad_format,
                   "the OpenXR runtime's pictures for the eyes cannot be drawn into with OpenGL: "
                   "expected textures, 8 bits, sRGB"};
    }
  }
  return pictures;
}

Result<std::unique_ptr<HeadsetSession>> HeadsetSession::create(const Headset& headset,
                                                               const GraphicsBinding& binding) {
  std::unique_ptr<HeadsetSession> session(new HeadsetSession(headset));
  if (Status made = session->create_session(binding); !made) return made.error();
  if (Status made = session->create_spaces(); !made) return made.error();
  if (Status made = session->create_hands(); !made) return made.error();
  for (const EyeSize& size : headset.eyes()) {
    Result<EyePictures> pictures =
        EyePictures::create(headset.api(), session->session_.get(), size);
    if (!pictures) return pictures.error();
    session->pictures_.push_back(std::move(pictures).value());
  }
  return session;
}

Status HeadsetSession::create_session(const GraphicsBinding& binding) {
  const XrApi& api = headset_->api();
  XrGraphicsRequirementsOpenGLKHR needs{};
  needs.type = XR_TYPE_GRAPHICS_REQUIREMENTS_OPENGL_KHR;
  XrResult result =
      api.xrGetOpenGLGraphicsRequirementsKHR(headset_->instance(), headset_->system(), &needs);
  if (XR_FAILED(result)) return refused("OpenGL (xrGetOpenGLGraphicsRequirementsKHR)", result);
  constexpr XrVersion kOurs = XR_MAKE_VERSION(4, 5, 0);
  if (needs.minApiVersionSupported > kOurs) {
    return Error{ErrorCode::not_found,
                 fmt::format("the OpenXR runtime wants OpenGL {}.{} or newer, and nade draws with "
                             "4.5: use another runtime for this headset",
                             XR_VERSION_MAJOR(needs.minApiVersionSupported),
                             XR_VERSION_MINOR(needs.minApiVersionSupported))};
  }
  XrSessionCreateInfo create{};
  create.type = XR_TYPE_SESSION_CREATE_INFO;
  create.next = binding.session_link();
  create.systemId = headset_->system();
  XrSession session = XR_NULL_HANDLE;
  result = api.xrCreateSession(headset_->instance(), &create, &session);
  if (XR_FAILED(result)) return refused("a session (xrCreateSession)", result);
  session_ = {session, api.xrDestroySession};

  std::uint32_t count = 0;
  result = api.xrEnumerateSwapchainFormats(session, 0, &count, nullptr);
  std::vector<std::int64_t> formats(count);
  if (XR_SUCCEEDED(result)) {
    result = api.xrEnumerateSwapchainFormats(session, count, &count, formats.data());
  }
  if (XR_FAILED(result)) return refused("to say what pictures it takes", result);
  if (std::find(formats.begin(), formats.end(), kColorFormat) == formats.end()) {
    return Error{ErrorCode::not_found,
                 "the OpenXR runtime takes no pictures in sRGB with 8 bits (GL_SRGB8_ALPHA8): use "
                 "another runtime for this headset"};
  }
  return ok_status();
}

Status HeadsetSession::create_spaces() {
  const XrApi& api = headset_->api();
  std::array<XrReferenceSpaceType, 32> offered{};
  std::uint32_t count = 0;
  XrResult result = api.xrEnumerateReferenceSpaces(
      session_.get(), static_cast<std::uint32_t>(offered.size()), &count, offered.data());
  if (XR_FAILED(result)) return refused("to say what spaces it has", result);
  const auto has = [&](XrReferenceSpaceType type) {
    return std::find(offered.begin(), offered.begin() + count, type) != offered.begin() + count;
  };
  XrReferenceSpaceType base = XR_REFERENCE_SPACE_TYPE_LOCAL;
  floor_y_ = -kSeatedEyes_m;
  if (headset_->has_local_floor() && has(XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT)) {
    base = XR_REFERENCE_SPACE_TYPE_LOCAL_FLOOR_EXT;
    floor_y_ = 0.0;
  } else if (has(XR_REFERENCE_SPACE_TYPE_STAGE)) {
    base = XR_REFERENCE_SPACE_TYPE_STAGE;
    floor_y_ = 0.0;
  }
  XrReferenceSpaceCreateInfo create{};
  create.type = XR_TYPE_REFERENCE_SPACE_CREATE_INFO;
  create.poseInReferenceSpace.orientation.w = 1.0F;
  XrSpace space = XR_NULL_HANDLE;
  create.referenceSpaceType = base;
  result = api.xrCreateReferenceSpace(session_.get(), &create, &space);
  if (XR_FAILED(result)) return refused("a space to locate things in", result);
  base_ = {space, api.xrDestroySpace};
  create.referenceSpaceType = XR_REFERENCE_SPACE_TYPE_VIEW;
  result = api.xrCreateReferenceSpace(session_.get(), &create, &space);
  if (XR_FAILED(result)) return refused("the head's space", result);
  head_ = {space, api.xrDestroySpace};
  return ok_status();
}

Status HeadsetSession::create_hands() {
  const XrApi& api = headset_->api();
  std::array<XrHandTrackingDataSourceEXT, 2> sources{XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT,
                                                     XR_HAND_TRACKING_DATA_SOURCE_CONTROLLER_EXT};
  XrHandTrackingDataSourceInfoEXT source{XR_TYPE_HAND_TRACKING_DATA_SOURCE_INFO_EXT, nullptr,
                                         static_cast<std::uint32_t>(sources.size()),
                                         sources.data()};
  for (std::size_t side = 0; side < 2; ++side) {
    XrHandTrackerCreateInfoEXT create{};
    create.type = XR_TYPE_HAND_TRACKER_CREATE_INFO_EXT;
    create.next = headset_->has_data_source() ? &source : nullptr;
    create.hand = side == index_of(Handedness::left) ? XR_HAND_LEFT_EXT : XR_HAND_RIGHT_EXT;
    create.handJointSet = XR_HAND_JOINT_SET_DEFAULT_EXT;
    XrHandTrackerEXT tracker = XR_NULL_HANDLE;
    const XrResult result = api.xrCreateHandTrackerEXT(session_.get(), &create, &tracker);
    if (XR_FAILED(result)) return refused("to track hands (xrCreateHandTrackerEXT)", result);
    hands_[side] = {tracker, api.xrDestroyHandTrackerEXT};
  }
  return ok_status();
}

bool HeadsetSession::check(XrResult result, const char* what) {
  if (result == XR_SESSION_LOSS_PENDING) {
    if (fate_ == Fate::goes_on) fate_ = Fate::session_lost;
    return true;
  }
  if (XR_SUCCEEDED(result)) return true;
  if (fate_ != Fate::goes_on) return false;
  complaint_ = fmt::format("the OpenXR runtime failed in {}: {}", what, name_of(result));
  switch (result) {
    case XR_ERROR_SESSION_LOST:
      fate_ = Fate::session_lost;
      break;
    case XR_ERROR_INSTANCE_LOST:
    case XR_ERROR_RUNTIME_FAILURE:
    case XR_ERROR_RUNTIME_UNAVAILABLE:
      fate_ = Fate::instance_lost;
      break;
    default:
      fate_ = Fate::failed;
      break;
  }
  return false;
}

void HeadsetSession::take_state(XrSessionState state) {
  const XrApi& api = headset_->api();
  state_ = state;
  switch (state) {
    case XR_SESSION_STATE_READY: {
      XrSessionBeginInfo begin{XR_TYPE_SESSION_BEGIN_INFO, nullptr,
                               XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO};
      running_ = check(api.xrBeginSession(session_.get(), &begin), "xrBeginSession");
      break;
    }
    case XR_SESSION_STATE_STOPPING:
      running_ = false;
      check(api.xrEndSession(session_.get()), "xrEndSession");
      break;
    case XR_SESSION_STATE_EXITING:
      fate_ = Fate::ended;
      break;
    case XR_SESSION_STATE_LOSS_PENDING:
      fate_ = Fate::session_lost;
      break;
    default:
      break;
  }
}

Fate HeadsetSession::poll() {
  while (fate_ == Fate::goes_on) {
    XrEventDataBuffer event{};
    event.type = XR_TYPE_EVENT_DATA_BUFFER;
    const XrResult result = headset_->api().xrPollEvent(headset_->instance(), &event);
    if (result == XR_EVENT_UNAVAILABLE || !check(result, "xrPollEvent")) break;
    if (event.type == XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING) {
      fate_ = Fate::instance_lost;
    } else if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
      XrEventDataSessionStateChanged change{};
      std::memcpy(&change, &event, sizeof change);
      if (change.session == session_.get()) take_state(change.state);
    }
  }
  return fate_;
}

void HeadsetSession::request_exit() {
  if (!running_) {
    fate_ = Fate::ended;
    return;
  }
  check(headset_->api().xrRequestExitSession(session_.get()), "xrRequestExitSession");
}

const TrackedFrame* HeadsetSession::begin_frame() {
  const XrApi& api = headset_->api();
  frame_state_ = {};
  frame_state_.type = XR_TYPE_FRAME_STATE;
  if (!check(api.xrWaitFrame(session_.get(), nullptr, &frame_state_), "xrWaitFrame") ||
      !check(api.xrBeginFrame(session_.get(), nullptr), "xrBeginFrame")) {
    return nullptr;
  }
  drawn_ = {};
  locate(frame_state_.predictedDisplayTime);
  return &frame_;
}

void HeadsetSession::locate(XrTime time) {
  const XrApi& api = headset_->api();
  frame_.time_ns = time;
  frame_.focused = state_ == XR_SESSION_STATE_FOCUSED;
  frame_.own_hands = true;
  frame_.floor_y = floor_y_;

  XrViewLocateInfo where{XR_TYPE_VIEW_LOCATE_INFO, nullptr,
                         XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, time, base_.get()};
  XrViewState state{XR_TYPE_VIEW_STATE, nullptr, 0};
  for (XrView& view : views_) view.type = XR_TYPE_VIEW;
  std::uint32_t count = 0;
  constexpr XrViewStateFlags kValid =
      XR_VIEW_STATE_ORIENTATION_VALID_BIT | XR_VIEW_STATE_POSITION_VALID_BIT;
  views_valid_ = check(api.xrLocateViews(session_.get(), &where, &state, 2, &count, views_.data()),
                       "xrLocateViews") &&
                 (state.viewStateFlags & kValid) == kValid;
  for (std::size_t eye = 0; eye < 2 && views_valid_; ++eye) {
    frame_.eyes[eye].pose = openxr::pose_from(views_[eye].pose);
    frame_.eyes[eye].view = view_from(views_[eye].fov);
  }
  frame_.draw = frame_state_.shouldRender == XR_TRUE && views_valid_;

  XrSpaceLocation head{};
  head.type = XR_TYPE_SPACE_LOCATION;
  constexpr XrSpaceLocationFlags kPose =
      XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
  frame_.head.reset();
  if (check(api.xrLocateSpace(head_.get(), base_.get(), time, &head), "xrLocateSpace") &&
      (head.locationFlags & kPose) == kPose) {
    frame_.head = openxr::pose_from(head.pose);
  }
  for (std::size_t side = 0; side < 2; ++side) locate_hand(side, time);
}

void HeadsetSession::locate_hand(std::size_t side, XrTime time) {
  frame_.hands[side].reset();
  XrHandJointsLocateInfoEXT where{XR_TYPE_HAND_JOINTS_LOCATE_INFO_EXT, nullptr, base_.get(), time};
  XrHandTrackingDataSourceStateEXT source{XR_TYPE_HAND_TRACKING_DATA_SOURCE_STATE_EXT, nullptr,
                                          XR_FALSE, XR_HAND_TRACKING_DATA_SOURCE_UNOBSTRUCTED_EXT};
  XrHandJointLocationsEXT located{};
  located.type = XR_TYPE_HAND_JOINT_LOCATIONS_EXT;
  located.next = headset_->has_data_source() ? &source : nullptr;
  located.jointCount = static_cast<std::uint32_t>(joints_.size());
  located.jointLocations = joints_.data();
  if (!check(headset_->api().xrLocateHandJointsEXT(hands_[side].get(), &where, &located),
             "xrLocateHandJointsEXT") ||
      located.isActive == XR_FALSE) {
    return;
  }
  const bool left = side == index_of(Handedness::left);
  frame_.hands[side] = openxr::hand_from(left ? Handedness::left : Handedness::right, joints_);
  if (source.isActive == XR_TRUE &&
      source.dataSource == XR_HAND_TRACKING_DATA_SOURCE_CONTROLLER_EXT) {
    frame_.own_hands = false;
  }
}

std::optional<draw::Target> HeadsetSession::acquire(std::size_t eye) {
  const XrApi& api = headset_->api();
  const EyePictures& pictures = pictures_[eye];
  std::uint32_t image = 0;
  if (!check(api.xrAcquireSwapchainImage(pictures.swapchain(), nullptr, &image),
             "xrAcquireSwapchainImage")) {
    return std::nullopt;
  }
  XrSwapchainImageWaitInfo wait{XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, nullptr, XR_INFINITE_DURATION};
  if (!check(api.xrWaitSwapchainImage(pictures.swapchain(), &wait), "xrWaitSwapchainImage")) {
    return std::nullopt;
  }
  return draw::Target{pictures.framebuffer(image), 0, 0, pictures.size().width,
                      pictures.size().height};
}

void HeadsetSession::release(std::size_t eye) {
  drawn_[eye] = check(headset_->api().xrReleaseSwapchainImage(pictures_[eye].swapchain(), nullptr),
                      "xrReleaseSwapchainImage");
}

void HeadsetSession::end_frame() {
  std::array<XrCompositionLayerProjectionView, 2> shown{};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    shown[eye].type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW;
    shown[eye].pose = views_[eye].pose;
    shown[eye].fov = views_[eye].fov;
    shown[eye].subImage.swapchain = pictures_[eye].swapchain();
    shown[eye].subImage.imageRect.extent = {pictures_[eye].size().width,
                                            pictures_[eye].size().height};
  }
  XrCompositionLayerProjection layer{};
  layer.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION;
  layer.space = base_.get();
  layer.viewCount = 2;
  layer.views = shown.data();
  const auto* const layers = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&layer);
  XrFrameEndInfo end{};
  end.type = XR_TYPE_FRAME_END_INFO;
  end.displayTime = frame_state_.predictedDisplayTime;
  end.environmentBlendMode = headset_->blend_mode();
  end.layerCount = drawn_[0] && drawn_[1] ? 1 : 0;
  end.layers = &layers;
  check(headset_->api().xrEndFrame(session_.get(), &end), "xrEndFrame");
}

}  // namespace nade::xr
