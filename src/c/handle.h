#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "failure.h"
#include "nade/corrector.h"
#include "nade/flatten_skin.h"
#include "nade/mesh.h"
#include "nade/surface_group.h"

namespace nade::c_abi {

/// What a handle points to. Its memory is never given back, so that one that was destroyed can be
/// told by its mark.
template <class Contents>
struct HandlePlace {
  std::atomic<std::uint32_t> mark{0};  ///< first in all kinds, so that another kind can be told
  std::optional<Contents> contents;
  HandlePlace* next_free = nullptr;
};

struct HeldSurface {
  std::vector<std::shared_ptr<const HeldSurface>> members;  ///< of a group; outlive `surface`
  std::unique_ptr<Surface> surface;
  MeshSurface* mesh = nullptr;            ///< `surface`, where it can be refitted
  SurfaceGroup* group = nullptr;          ///< `surface`, where it is one
  std::vector<Eigen::Vector3f> vertices;  ///< of the mesh, to be refitted without allocating
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
};

struct HeldScene {
  std::unordered_map<ObjectId, std::shared_ptr<const HeldSurface>> surfaces;  ///< outlive `scene`
  Scene scene;
};

struct HeldFlesh {
  std::shared_ptr<const HandFlesh> flesh;
  SkinDepths skin;
};

struct HeldCorrector {
  std::shared_ptr<const HeldSurface> surface;  ///< the last: its address must not be another's
  HandCorrector corrector;
};

struct HeldSkin {
  std::shared_ptr<const HeldSurface> surface;  ///< the last: its address must not be another's
  HandMesh mesh;
  SkinFlattener flattener;
};

}  // namespace nade::c_abi

struct nade_surface : nade::c_abi::HandlePlace<std::shared_ptr<nade::c_abi::HeldSurface>> {};
struct nade_scene : nade::c_abi::HandlePlace<nade::c_abi::HeldScene> {};
struct nade_flesh : nade::c_abi::HandlePlace<nade::c_abi::HeldFlesh> {};
struct nade_corrector : nade::c_abi::HandlePlace<nade::c_abi::HeldCorrector> {};
struct nade_skin : nade::c_abi::HandlePlace<nade::c_abi::HeldSkin> {};

namespace nade::c_abi {

template <class Handle>
struct HandleKind;
template <>
struct HandleKind<nade_surface> {
  static constexpr std::uint32_t kMark = 0x6e616401;
  static constexpr const char* kName = "surface";
};
template <>
struct HandleKind<nade_scene> {
  static constexpr std::uint32_t kMark = 0x6e616402;
  static constexpr const char* kName = "scene";
};
template <>
struct HandleKind<nade_flesh> {
  static constexpr std::uint32_t kMark = 0x6e616403;
  static constexpr const char* kName = "flesh";
};
template <>
struct HandleKind<nade_corrector> {
  static constexpr std::uint32_t kMark = 0x6e616404;
  static constexpr const char* kName = "corrector";
};
template <>
struct HandleKind<nade_skin> {
  static constexpr std::uint32_t kMark = 0x6e616405;
  static constexpr const char* kName = "skin";
};

#ifdef __STDCPP_THREADS__
using Mutex = std::mutex;
#else
struct Mutex {
  void lock() {}
  void unlock() {}
};
#endif

/// All handles of a kind. A place is taken again only when many were destroyed after it.
template <class Handle>
class HandlePool {
 public:
  template <class Contents>
  [[nodiscard]] static Handle* take(Contents&& contents) {
    Handle* const handle = instance().free_place();
    handle->contents.emplace(std::forward<Contents>(contents));
    handle->mark.store(HandleKind<Handle>::kMark, std::memory_order_release);
    return handle;
  }

  /// False where it was destroyed before, or is no such handle.
  [[nodiscard]] static bool give_back(Handle* handle) noexcept {
    std::uint32_t mark = HandleKind<Handle>::kMark;
    if (!handle->mark.compare_exchange_strong(mark, 0)) return false;
    handle->contents.reset();
    HandlePool& pool = instance();
    const std::lock_guard lock(pool.mutex_);
    (pool.last_free_ != nullptr ? pool.last_free_->next_free : pool.first_free_) = handle;
    pool.last_free_ = handle;
    ++pool.free_count_;
    return true;
  }

 private:
  static constexpr std::size_t kKeptFree = 64;

  [[nodiscard]] static HandlePool& instance() {
    static HandlePool* const kPool = new HandlePool;  // handles may be destroyed after `main`
    return *kPool;
  }

  [[nodiscard]] Handle* free_place() {
    const std::lock_guard lock(mutex_);
    if (free_count_ <= kKeptFree) return &places_.emplace_back();
    auto* const place = static_cast<Handle*>(first_free_);
    first_free_ = std::exchange(place->next_free, nullptr);
    --free_count_;
    return place;
  }

  using Place = decltype(std::declval<Handle&>().next_free);

  Mutex mutex_;
  std::deque<Handle> places_;
  Place first_free_ = nullptr;
  Place last_free_ = nullptr;
  std::size_t free_count_ = 0;
};

template <class Handle>
[[nodiscard]] bool is_alive(const Handle* handle) noexcept {
  return handle->mark.load(std::memory_order_acquire) == HandleKind<Handle>::kMark;
}

/// NADE_OK, or the error of a handle that is NULL, destroyed or of another kind.
template <class Handle>
[[nodiscard]] nade_status check_handle(const Handle* handle, const char* name) noexcept {
  if (handle == nullptr) return fail(NADE_ERROR_HANDLE, "%s: expected a handle, found NULL", name);
  if (is_alive(handle)) return NADE_OK;
  return fail(NADE_ERROR_HANDLE, "%s: expected a %s, found one that was destroyed, or no %s", name,
              HandleKind<Handle>::kName, HandleKind<Handle>::kName);
}

/// For all `destroy`s.
template <class Handle>
[[nodiscard]] nade_status destroy(const char* function, Handle* handle) noexcept {
  return guarded(function, [&] {
    if (handle == nullptr || HandlePool<Handle>::give_back(handle)) return nade_status{NADE_OK};
    return check_handle(handle, HandleKind<Handle>::kName);
  });
}

}  // namespace nade::c_abi
