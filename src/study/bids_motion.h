#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nade/status.h"

namespace nade::study {

/// A recording as it goes into a BIDS dataset.
struct BidsMotion {
  std::string recording;  ///< the file it comes from
  std::string folder;     ///< ".../sub-P01/motion"
  /// "sub-P01_task-stroking": before "_tracksys-…"
  std::string stem;
  std::string run;         ///< "_run-01", with what follows before the suffix
  std::string about_json;  ///< keys that every sidecar has, an object
  bool with_head = false;  ///< whether the head is written beside the hands
};

/// Writes `…_motion.tsv`, `…_motion.json`, `…_channels.tsv` and `…_channels.json` of the hands and,
/// where there is one, of the head; the names of the motion files, from the participant's folder.
[[nodiscard]] Result<std::vector<std::string>> write_bids_motion(const BidsMotion& motion);

}  // namespace nade::study
