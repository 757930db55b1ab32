// Operates the two halves of the timeline, the list of layers and the tracks, as the artist would.
#pragma once

#include <QEvent>
#include <QPointer>
#include <QWidget>

namespace lampblack
{

/// Height of a row, and of the header above the rows.
constexpr int TimelineRowHeight = 20;

/// Scrolls cells to a row (vertical) or to the frame after `place` (horizontal) while it exists, then back.
/// The scroll bars stay.
class ScrolledCells
{
public:
    ScrolledCells(QWidget* cells, Qt::Orientation orientation, int place);
    ~ScrolledCells();
    Q_DISABLE_COPY_MOVE(ScrolledCells)

private:
    void scrollTo(int place) const;

    QPointer<QWidget> mCells;
    Qt::Orientation mOrientation;
};

/// Send an event of the left button, `at` in the widget's own coordinates.
void sendMouse(QWidget* widget, QEvent::Type type, const QPoint& at, Qt::MouseButtons buttons);

/// Always both: Pencil2D takes a release alone for the end of a drag.
void sendClick(QWidget* widget, const QPoint& at);

} // namespace lampblack
