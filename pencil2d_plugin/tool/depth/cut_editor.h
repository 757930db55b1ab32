// Corrects what is in front with the pointer, in the Depth view.
#pragma once

#include "scene/scene_document.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/pointer_filter.h"
#include "tool/depth/cuts.h"

namespace lampblack
{

/// While it listens, a click on a cut brings its other side in front, and a drag draws a new cut. A right
/// click asks for a menu. Each is an edit of the document at the current frame. The overlay shows the cuts.
class CutEditor : public PointerFilter
{
    Q_OBJECT

public:
    CutEditor(Host& host, SceneDocument& document, CanvasOverlay& overlay);

    /// Where the drawing of a frame overlaps itself, as it was found.
    void setOverlaps(int frame, const QVector<Overlap>& overlaps);
    /// The drawing of the current frame.
    void setFrame(const FrameExport& frame) { mDrawing = frame; }

    const QVector<Cut>& cuts() const { return mCuts; }
    const Cut* hovered() const;
    bool isDrawing() const { return !mStroke.isEmpty(); }
    void cancelStroke();

    // Edits of one cut.
    void bringOtherSideInFront(const Cut& cut);
    void join(const Cut& cut);
    void moveApart(const Cut& cut);
    void moveTogether(const Cut& cut);
    void removeCorrection(const Cut& cut);

Q_SIGNALS:
    /// `cut` is a cut under the pointer, or null.
    void menuRequested(const lampblack::Cut* cut, const QPoint& global);

protected:
    bool handlePress(const Pointer& pointer) override;
    bool handleMove(const Pointer& pointer) override;
    bool handleRelease(const Pointer& pointer) override;
    void handleLeave() override;
    void handleListening() override;

private:
    void refresh();
    void setHovered(int cut);
    int cutAt(const Pointer& pointer) const;
    void addStroke();
    void edit(const QString& text, const Scene& scene, const Cut& cut);
    double characterSide() const;
    QPointF toCanvas(const QPointF& position) const;

    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    FrameExport mDrawing;
    QVector<Overlap> mOverlaps;
    int mOverlapsFrame = 0;
    QVector<Cut> mCuts;
    int mHovered = -1;
    std::optional<Pointer> mPointer; ///< as it was last seen over the canvas
    QString mStatus;                 ///< what the status bar was told last
    QPolygonF mStroke;               ///< canvas pixels; empty while none is drawn
    QPointF mPressPosition;
    bool mIsPressed = false;
    bool mSwallowRelease = false;
};

} // namespace lampblack
