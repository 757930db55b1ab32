#include "tool/depth/hint_edit.h"

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr double Notch = 1.5;
constexpr double FirstNotch = 2; // what was found is a mean: steps are lower towards their ends
constexpr double UsualAmount = 0.03;
constexpr double LeastAmount = 0.005;

/// 0 if no hint says it.
double hintedAmount(const Scene& scene, const Cut& cut)
{
    return cut.hint >= 0 ? scene.depth.hints[cut.hint].amount : 0;
}

double amountOf(const Scene& scene, const Cut& cut, double side)
{
    const double hinted = hintedAmount(scene, cut);
    if (hinted > 0)
        return hinted;
    return cut.amount > 0 && side > 0 ? cut.amount / side : UsualAmount;
}

/// With the hint of the cut, made if there is none yet, changed by `change`.
template <class Change> Scene withHint(const Scene& scene, int frame, const Cut& cut, Change change)
{
    Scene result = scene;
    if (!canCorrect(scene, cut))
        return result;
    QVector<DepthHint>& hints = result.depth.hints;
    if (cut.hint >= 0)
    {
        change(hints[cut.hint]);
        return result;
    }
    DepthHint hint;
    hint.frame = frame;
    hint.front = cut.front;
    const QPolygonF line = simplified(cut.line, MaxHintPoints);
    for (const QPointF& point : line)
        hint.points.append({point.x(), point.y(), {}});
    change(hint);
    hints.append(hint);
    return result;
}

} // namespace

bool canCorrect(const Scene& scene, const Cut& cut)
{
    return cut.hint >= 0 ? cut.hint < scene.depth.hints.size() : scene.depth.hints.size() < MaxHints;
}

Scene withFront(const Scene& scene, int frame, const Cut& cut, FrontSide front)
{
    return withHint(scene, frame, cut, [front](DepthHint& hint) { hint.front = front; });
}

Scene withAmount(const Scene& scene, int frame, const Cut& cut, double amount)
{
    return withHint(scene, frame, cut, [amount](DepthHint& hint) { hint.amount = amount; });
}

double furtherApart(const Scene& scene, const Cut& cut, double side)
{
    const double notch = hintedAmount(scene, cut) > 0 ? Notch : FirstNotch;
    return std::min(1.0, amountOf(scene, cut, side) * notch);
}

double nearerTogether(const Scene& scene, const Cut& cut, double side)
{
    return std::max(LeastAmount, amountOf(scene, cut, side) / Notch);
}

Scene withoutHint(const Scene& scene, const Cut& cut)
{
    Scene result = scene;
    if (cut.hint >= 0 && cut.hint < result.depth.hints.size())
        result.depth.hints.remove(cut.hint);
    return result;
}

Scene withoutHints(const Scene& scene, std::optional<int> frame)
{
    Scene result = scene;
    QVector<DepthHint>& hints = result.depth.hints;
    hints.erase(std::remove_if(hints.begin(), hints.end(),
                               [frame](const DepthHint& hint) { return !frame || hint.frame == *frame; }),
                hints.end());
    return result;
}

FrontSide otherSide(FrontSide front)
{
    return front == FrontSide::Left ? FrontSide::Right : FrontSide::Left;
}

int longerSideOf(const QImage& drawing)
{
    constexpr int Alpha = 3;
    QRect box;
    for (int y = 0; y < drawing.height(); ++y)
    {
        const uchar* row = drawing.constScanLine(y);
        int left = 0;
        int right = drawing.width() - 1;
        while (left <= right && row[4 * left + Alpha] == 0)
            ++left;
        while (right > left && row[4 * right + Alpha] == 0)
            --right;
        if (left <= right)
            box |= QRect(QPoint(left, y), QPoint(right, y));
    }
    return std::max({1, box.width(), box.height()});
}

} // namespace lampblack
