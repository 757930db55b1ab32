// Turns mouse, pen and wheel events of the canvas into edits of the scene.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/drag.h"
#include "tool/gesture.h"

#include <QCursor>
#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include <optional>

namespace lampblack
{

/// An event filter of the canvas. While it listens it takes the left button, the right button and the wheel
/// over a handle. Everything else (panning, zooming) goes to the drawing program.
class CanvasInput : public QObject
{
    Q_OBJECT

public:
    CanvasInput(Host& host, SceneDocument& document, CanvasOverlay& overlay);
    ~CanvasInput() override;

    bool isListening() const { return mListening; }
    void setListening(bool listening);

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
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Pointer
    {
        QPointF position; ///< widget coordinates
        QPoint global;
        Qt::MouseButton button = Qt::NoButton;
        Qt::MouseButtons buttons;
        Qt::KeyboardModifiers modifiers;
    };
    bool handleMouse(QEvent* event);
    bool handleTablet(QEvent* event);
    bool handlePress(const Pointer& pointer);
    bool handleMove(const Pointer& pointer);
    bool handleRelease(const Pointer& pointer);
    bool handleWheel(QEvent* event);
    void continueDrag(const Pointer& pointer);
    void showValueTag(const Handle& handle, const QPointF& position, Drag::Kind kind);
    void updateCursor();
    void restoreCursor();
    QPointF toCanvas(const QPointF& position) const;

    Host& mHost;
    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    std::optional<Drag> mDrag;
    QPointF mPressPosition;
    bool mHasMoved = false;
    bool mSwallowRelease = false;
    bool mListening = false;
    bool mPicking = false;
    bool mPenDown = false;
    GestureSequence mWheelGestures;
    QElapsedTimer mSinceZoom; ///< since the drawing program last got a wheel event
    QTimer mTagTimer;
    QCursor mLampCursor;
    std::optional<QCursor> mCursorBefore;
    QCursor mCursorShown;
};

} // namespace lampblack
