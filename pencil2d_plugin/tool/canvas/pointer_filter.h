// Mouse and pen on the canvas, as one kind of pointer.
#pragma once

#include "host/host.h"

#include <QCursor>
#include <QWheelEvent>

#include <optional>

namespace lampblack
{

/// An event filter of the canvas. While it listens, events that its functions take do not reach the drawing
/// program.
class PointerFilter : public QObject
{
    Q_OBJECT

public:
    /// host.canvas() must not be null.
    PointerFilter(Host& host, QObject* parent);
    ~PointerFilter() override;

    bool isListening() const { return mListening; }
    void setListening(bool listening);

protected:
    struct Pointer
    {
        QPointF position; ///< widget coordinates
        QPoint global;
        Qt::MouseButton button = Qt::NoButton;
        Qt::MouseButtons buttons;
        Qt::KeyboardModifiers modifiers;
        bool isPen = false;
    };

    // True if the event is taken.
    virtual bool handlePress(const Pointer& pointer) = 0;
    virtual bool handleMove(const Pointer& pointer) = 0;
    virtual bool handleRelease(const Pointer& pointer) = 0;
    virtual bool handleWheel(QWheelEvent& /*wheel*/) { return false; }
    virtual void handleLeave() = 0;
    /// It has begun or ceased to listen.
    virtual void handleListening() = 0;

    void showCursor(const QCursor& cursor);
    Host& host() const { return mHost; }
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    bool handleMouse(QEvent& event);
    bool handleTablet(QEvent& event);
    void restoreCursor();

    Host& mHost;
    bool mListening = false;
    bool mPenDown = false;
    std::optional<QCursor> mCursorBefore;
    QCursor mCursorShown;
};

} // namespace lampblack
