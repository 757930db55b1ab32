// Corrects the surface with a brush, in the Depth view.
#pragma once

#include "scene/scene_document.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/pointer_filter.h"
#include "tool/depth/brush_painter.h"
#include "tool/gesture.h"

#include <QTimer>

namespace lampblack
{

/// While it listens, a drag draws a stroke of the chosen brush, which is an edit of the document at the
/// current frame. The wheel sets the radius, and with Shift the strength. A right click asks for a menu.
class BrushEditor : public PointerFilter
{
    Q_OBJECT

public:
    BrushEditor(Host& host, SceneDocument& document, CanvasOverlay& overlay);

    const BrushSettings& brush() const { return mView.brush; }
    void setBrush(Brush brush);

    bool isDrawing() const { return !mView.drawn.isEmpty(); }
    void cancelStroke();

    /// Index, into the strokes of the scene, of the one under the pointer, or -1.
    int hovered() const { return mHovered; }
    void removeStroke(int stroke);

Q_SIGNALS:
    /// `stroke` is the index of the stroke under the pointer, or -1.
    void menuRequested(int stroke, const QPoint& global);

protected:
    bool handlePress(const Pointer& pointer) override;
    bool handleMove(const Pointer& pointer) override;
    bool handleRelease(const Pointer& pointer) override;
    bool handleWheel(QWheelEvent& wheel) override;
    void handleLeave() override;
    void handleListening() override;

private:
    void refresh();
    void hover(const Pointer& pointer);
    void show();
    void addStroke();
    double longerSide() const;
    QPointF toCanvas(const QPointF& position) const;

    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    BrushView mView;
    int mHovered = -1;
    double mRadiusShare; ///< of the canvas's longer side
    QTimer mTagTimer;
    bool mSwallowRelease = false;
};

} // namespace lampblack
