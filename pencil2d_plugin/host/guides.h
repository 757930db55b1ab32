// The guides that Pencil2D 0.7 paints over its drawing: thirds, safe areas, lines of a perspective.
#pragma once

#include "host/parts.h"

QT_FORWARD_DECLARE_CLASS(QPainter)

namespace lampblack
{

class Guides
{
public:
    explicit Guides(const Parts& parts);

    /// Paint those that are shown once more, above what now covers them. `painter` is in coordinates of the
    /// canvas widget. They invert what is beneath them: painted where they are to be seen already, they
    /// vanish.
    void paint(QPainter* painter) const;

private:
    QPointer<QWidget> mCanvas;
    QVector<QPointer<QAction>> mActions; ///< checked while a guide is shown; none in Pencil2D 0.6
};

} // namespace lampblack
