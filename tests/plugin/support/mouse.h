// A mouse, as the window system would move it.
#pragma once

#include <QCoreApplication>
#include <QMouseEvent>
#include <QWidget>

namespace lampblack
{

/// Modifiers and held buttons included.
inline void sendMouse(QWidget* widget, QEvent::Type type, const QPointF& at, Qt::MouseButton button,
                      Qt::MouseButtons held, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
    QMouseEvent event(type, at, widget->mapToGlobal(at.toPoint()), button, held, modifiers);
    QCoreApplication::sendEvent(widget, &event);
}

/// Press at the first point, move through the others, and release at the last.
inline void dragMouse(QWidget* widget, const QVector<QPointF>& way,
                      Qt::KeyboardModifiers modifiers = Qt::NoModifier, bool release = true)
{
    sendMouse(widget, QEvent::MouseButtonPress, way.first(), Qt::LeftButton, Qt::LeftButton, modifiers);
    for (const QPointF& at : way.mid(1))
        sendMouse(widget, QEvent::MouseMove, at, Qt::NoButton, Qt::LeftButton, modifiers);
    if (release)
        sendMouse(widget, QEvent::MouseButtonRelease, way.last(), Qt::LeftButton, Qt::NoButton, modifiers);
}

} // namespace lampblack
