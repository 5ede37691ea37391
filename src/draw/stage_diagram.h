#pragma once

#include "nade/draw/stage.h"

namespace nade::draw {

/// Adds what `frame.overlays` asks for about one hand to a scene: lines, arrows, dots, labels.
void add_diagram(const StagedHand& hand, const StageFrame& frame, Scene& scene);

}  // namespace nade::draw
