// Corrections of what is in front, as edits of the scene.
#pragma once

#include "tool/depth/cuts.h"

#include <QImage>

#include <optional>

namespace lampblack
{

constexpr int MaxHints = 128; ///< of the schema, as the next
constexpr int MaxHintPoints = 16;

/// Whether a correction of this cut fits into the scene.
bool canCorrect(const Scene& scene, const Cut& cut);

// Each writes a hint at `frame`, or changes the hint that the cut already is. Without room they return the
// scene as it was.
Scene withFront(const Scene& scene, int frame, const Cut& cut, FrontSide front);
/// `amount` is a share of the longer side of the character's box; 0 leaves it to the worker.
Scene withAmount(const Scene& scene, int frame, const Cut& cut, double amount);

/// The height of the step of a cut, larger or smaller by one notch, as withAmount() takes it. `side` is the
/// longer side of the character's box, canvas pixels.
double furtherApart(const Scene& scene, const Cut& cut, double side);
double nearerTogether(const Scene& scene, const Cut& cut, double side);

/// Without the hint that the cut is; unchanged if it is none of this frame.
Scene withoutHint(const Scene& scene, const Cut& cut);
/// Without all hints of `frame`, or of all frames.
Scene withoutHints(const Scene& scene, std::optional<int> frame = {});

/// Where a click brings the other side in front; of a joined cut, its left side.
FrontSide otherSide(FrontSide front);

/// Longer side of the box around what is drawn, pixels of the image; at least 1.
int longerSideOf(const QImage& drawing);

} // namespace lampblack
