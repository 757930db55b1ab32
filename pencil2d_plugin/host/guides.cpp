#include "host/guides.h"

#include "host/paint_filter.h"

#include <QPainter>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr const char* GuideActions[] = {"actionCenter",
                                        "actionThirds",
                                        "actionGoldenRatio",
                                        "actionSafeAreas",
                                        "actionOnePointPerspective",
                                        "actionTwoPointPerspective",
                                        "actionThreePointPerspective"};

/// Passes on what is painted with a composition mode of the guides' kind, which nothing else on the canvas
/// is.
class GuideFilter : public PaintFilter
{
public:
    explicit GuideFilter(QPainter* target) : mTarget(target) {}

    void drawPath(const QPainterPath& path) override
    {
        if (take())
            mTarget->drawPath(path);
    }
    void drawPolygon(const QPointF* points, int count, PolygonDrawMode mode) override
    {
        if (!take())
            return;
        if (mode == PolylineMode)
            mTarget->drawPolyline(points, count);
        else
            mTarget->drawPolygon(points, count, mode == WindingMode ? Qt::WindingFill : Qt::OddEvenFill);
    }
    void drawLines(const QLineF* lines, int count) override
    {
        if (take())
            mTarget->drawLines(lines, count);
    }
    void drawTextItem(const QPointF& at, const QTextItem& item) override
    {
        if (take())
            mTarget->drawText(at, item.text());
    }

private:
    /// Whether what comes belongs to a guide. Then the target paints as the canvas does.
    bool take()
    {
        const QPainter& source = *painter();
        if (source.compositionMode() == QPainter::CompositionMode_SourceOver)
            return false;
        mTarget->setCompositionMode(source.compositionMode());
        mTarget->setPen(source.pen());
        mTarget->setBrush(source.brush());
        mTarget->setFont(source.font());
        mTarget->setRenderHints(mTarget->renderHints(), false);
        mTarget->setRenderHints(source.renderHints());
        mTarget->setWorldTransform(source.combinedTransform());
        return true;
    }

    QPainter* mTarget;
};

} // namespace

Guides::Guides(const Parts& parts) : mCanvas(parts.canvas)
{
    for (const char* name : GuideActions)
    {
        if (QAction* action = parts.action(name))
            mActions.append(action);
    }
}

void Guides::paint(QPainter* painter) const
{
    const bool isShown =
        std::any_of(mActions.begin(), mActions.end(),
                    [](const QPointer<QAction>& action) { return action && action->isChecked(); });
    if (!isShown || mCanvas == nullptr)
        return;
    painter->save();
    GuideFilter filter(painter);
    paintInto(&filter, mCanvas);
    painter->restore();
}

} // namespace lampblack
