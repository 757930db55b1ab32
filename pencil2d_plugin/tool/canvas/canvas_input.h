// Turns mouse, pen and wheel events of the canvas into edits of the scene.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/drag.h"
#include "tool/canvas/pointer_filter.h"
#include "tool/gesture.h"

#include <QElapsedTimer>
#include <QTimer>

#include <optional>

namespace lampblack
{

/// While it listens it takes the left button, the right button and the wheel over a handle. Everything else
/// (panning, zooming) goes to the drawing program.
class CanvasInput : public PointerFilter
{
    Q_OBJECT

public:
    CanvasInput(Host& host, SceneDocument& document, CanvasOverlay& overlay);

    /// While picking, the next click on the canvas picks a colour.
    void setPicking(bool picking);
    bool isPicking() const { return mPicking; }

    bool isDragging() const { return mDrag.has_value(); }
    /// Move what is dragged back, and end the drag.
    void cancelDrag();

Q_SIGNALS:
    /// `canvas` is the position in canvas pixels, here and in the other signals.
    void pointerMoved(const QPointF& canvas);
    void pointerLeft();
    void menuRequested(const QPointF& canvas, const QPoint& global, const lampblack::Handle& handle);
    void colourPicked(const QPointF& canvas);
    void pickingChanged(bool picking);

protected:
    bool handlePress(const Pointer& pointer) override;
    bool handleMove(const Pointer& pointer) override;
    bool handleRelease(const Pointer& pointer) override;
    bool handleWheel(QWheelEvent& wheel) override;
    void handleLeave() override;
    void handleListening() override;

private:
    void continueDrag(const Pointer& pointer);
    void showValueTag(const Handle& handle, const QPointF& position, Drag::Kind kind);
    void updateCursor();
    QPointF toCanvas(const QPointF& position) const;

    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    std::optional<Drag> mDrag;
    QPointF mPressPosition;
    bool mHasMoved = false;
    bool mSwallowRelease = false;
    bool mPicking = false;
    GestureSequence mWheelGestures;
    QElapsedTimer mSinceZoom; ///< since the drawing program last got a wheel event
    QTimer mTagTimer;
    QCursor mLampCursor;
};

} // namespace lampblack
