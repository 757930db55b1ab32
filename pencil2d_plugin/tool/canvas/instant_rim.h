// The rim of a look, for instant shading. See rim.py.
#pragma once

#include "scene/linear_light.h"
#include "scene/scene.h"
#include "tool/canvas/instant_edges.h"

#include <QTransform>

namespace lampblack
{

/// A band of light inside the silhouette of a drawing.
class InstantRim
{
public:
    /// No rim.
    InstantRim() = default;
    /// The rim of `scene`, which is without keys, along `edges`. `canvasToImage` is the camera of the
    /// drawing.
    InstantRim(const Scene& scene, const InstantEdges& edges, const QTransform& canvasToImage);

    /// How much of the rim's light there is at a place of the image, 0 to 1.
    float shareAt(double x, double y) const;

    /// Add `share` of the rim to `shown`, the lit colour of paint that is drawn as `drawn`, red, green and
    /// blue. Both are sRGB, 0 to 255; `shown` may be brighter.
    void add(float share, const uchar* drawn, std::array<float, 3>& shown) const;

private:
    static constexpr size_t Bytes = 256;

    /// How far the rim is left out at an element, since that faces the strongest light.
    double leftOut(int column, int row) const;

    InstantEdges mEdges;                     ///< empty: there is no rim
    std::array<LinearColour, Bytes> mAims{}; ///< its light on paint, for each byte of what is drawn
    double mWidth = 0;                       ///< image pixels
    double mSoft = 0;                        ///< half of the blend at the inner side
    double mStrength = 0;
    double mAway = 0;
    QPointF mKey; ///< where the strongest light is, image pixels
};

} // namespace lampblack
