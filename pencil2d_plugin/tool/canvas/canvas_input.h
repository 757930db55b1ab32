// Mouse, pen and wheel on the canvas, turned into edits of the scene.
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

/// Filters the canvas's events. While it listens, left button, right button and a wheel over a handle
/// are ours; everything else (panning, zooming) goes to the drawing program.
class CanvasInput : public QObject
{
    Q_OBJECT

public:
    CanvasInput(Host& host, SceneDocument& document, CanvasOverlay& overlay);
    ~CanvasInput() override;

    bool isListening() const { return mListening; }
    void setListening(bool listening);

    /// The next click on the canvas picks a colour instead.
    void setPicking(bool picking);
    bool isPicking() const { return mPicking; }

    bool isDragging() const { return mDrag.has_value(); }
    /// Put back what is dragged and forget the drag.
    void cancelDrag();

Q_SIGNALS:
    /// The pointer is over a point of the canvas, canvas pixels.
    void pointed(const QPointF& canvas);
    void left();
    void menuRequested(const QPointF& canvas, const QPoint& global, const lampblack::Handle& handle);
    void picked(const QPointF& canvas);
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
    bool mouse(QEvent* event);
    bool tablet(QEvent* event);
    bool press(const Pointer& pointer);
    bool move(const Pointer& pointer);
    bool release(const Pointer& pointer);
    bool wheel(QEvent* event);
    void drag(const Pointer& pointer);
    void tell(const Handle& handle, const QPointF& beside, Drag::Kind kind);
    void showCursor();
    void restoreCursor();
    QPointF onCanvas(const QPointF& position) const;

    Host& mHost;
    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    std::optional<Drag> mDrag;
    QPointF mPressed;
    bool mMoved = false;
    bool mSwallowRelease = false;
    bool mListening = false;
    bool mPicking = false;
    bool mPenDown = false;
    GestureRun mWheelRun;
    QElapsedTimer mZoomed; ///< since the wheel last went to the drawing program
    QTimer mTagTimer;
    QCursor mLampCursor;
    std::optional<QCursor> mCursorBefore;
    QCursor mCursorShown;
};

} // namespace lampblack
