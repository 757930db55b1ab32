#include "tool/canvas/instant_rim.h"

#include "tool/canvas/full_light.h"

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{

constexpr double PlainRim = 0.25; ///< share of its light that does not take the colour of the paint
constexpr double Soft = 0.15;

QPointF strongestLight(const Scene& scene)
{
    QPointF place;
    double strongest = 0;
    const QVector<LampStrength> lamps = shiningLights(scene);
    for (const LampStrength& lamp : lamps)
    {
        if (lamp.strength <= strongest)
            continue;
        strongest = lamp.strength;
        place = lamp.place.toPointF();
    }
    return place;
}

/// A function of 0 to 1, by a table: a picture asks for it a hundred thousand times.
class Curve
{
public:
    template <typename Function> explicit Curve(Function function)
    {
        for (size_t i = 0; i < mValues.size(); ++i)
            mValues[i] = float(function(double(i) / double(mValues.size() - 1)));
    }
    float at(float place) const
    {
        const float exact = std::clamp(place, 0.0F, 1.0F) * float(mValues.size() - 1);
        const size_t before = std::min(size_t(exact), mValues.size() - 2);
        return mValues[before] + (exact - float(before)) * (mValues[before + 1] - mValues[before]);
    }

private:
    std::array<float, 1025> mValues{};
};

double smoothStep(double share)
{
    return share * share * (3 - 2 * share);
}

} // namespace

InstantRim::InstantRim(const Scene& scene, const InstantEdges& edges, const QTransform& canvasToImage)
{
    if (!scene.rim || scene.rim->strength <= 0)
        return;
    mEdges = edges;
    const LinearColour colour = linearColour(scene.rim->colour);
    for (size_t byte = 0; byte < Bytes; ++byte)
        for (size_t i = 0; i < colour.size(); ++i)
            mAims[byte][i] =
                colour[i] * (PlainRim + (1 - PlainRim) * std::sqrt(toLinear(double(byte) / (Bytes - 1))));
    mWidth = scene.rim->width * std::sqrt(std::abs(canvasToImage.determinant()));
    mSoft = std::max(Soft * mWidth, 0.9);
    mStrength = scene.rim->strength;
    mAway = scene.rim->away;
    mKey = canvasToImage.map(strongestLight(scene));
}

float InstantRim::shareAt(double x, double y) const
{
    if (mEdges.isEmpty())
        return 0;
    const int columns = mEdges.size.width();
    const int rows = mEdges.size.height();
    const double across = std::clamp(x / mEdges.step - 0.5, 0.0, columns - 1.0);
    const double down = std::clamp(y / mEdges.step - 0.5, 0.0, rows - 1.0);
    const int left = int(across);
    const int top = int(down);
    const float* distance = mEdges.distance.constData();
    // Most places are far from the edge.
    if (distance[mEdges.at(left, top)] > mWidth + mSoft + 2 * mEdges.step)
        return 0;
    const int right = std::min(left + 1, columns - 1);
    const int bottom = std::min(top + 1, rows - 1);
    const double beside = across - left;
    const auto inRow = [&](int row)
    {
        const double one = distance[mEdges.at(left, row)];
        return one + beside * (distance[mEdges.at(right, row)] - one);
    };
    const double above = inRow(top);
    const double here = above + (down - top) * (inRow(bottom) - above);
    const double share = std::clamp((mWidth - here) / (2 * mSoft) + 0.5, 0.0, 1.0);
    if (share <= 0)
        return 0;
    return float(mStrength * smoothStep(share) * (1 - leftOut(int(across + 0.5), int(down + 0.5))));
}

double InstantRim::leftOut(int column, int row) const
{
    if (mAway <= 0)
        return 0;
    const int step = 2 + int(0.75 * mWidth / mEdges.step);
    const auto distance = [&](int x, int y)
    {
        return double(mEdges.distance[mEdges.at(std::clamp(x, 0, mEdges.size.width() - 1),
                                                std::clamp(y, 0, mEdges.size.height() - 1))]);
    };
    const double inX = distance(column + step, row) - distance(column - step, row);
    const double inY = distance(column, row + step) - distance(column, row - step);
    const QPointF way = mKey - QPointF(column + 0.5, row + 0.5) * mEdges.step;
    const double length = std::max(1e-6, std::hypot(inX, inY) * std::hypot(way.x(), way.y()));
    const double facing = -(inX * way.x() + inY * way.y()) / length;
    return mAway * smoothStep(std::clamp((facing + 0.7) / 1.4, 0.0, 1.0));
}

void InstantRim::add(float share, const uchar* drawn, std::array<float, 3>& shown) const
{
    static const Curve linear([](double value) { return toLinear(value); });
    // By the square root, beside which the curve is nearly straight.
    static const Curve encoded([](double root) { return fromLinear(root * root); });
    for (size_t i = 0; i < shown.size(); ++i)
    {
        const float fill = linear.at(shown[i] / 255);
        const auto aim = float(mAims[drawn[i]][i]);
        if (aim > fill)
            shown[i] = std::max(shown[i], 255 * encoded.at(std::sqrt(fill + share * (aim - fill))));
    }
}

} // namespace lampblack
