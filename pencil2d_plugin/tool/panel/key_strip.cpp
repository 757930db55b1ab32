#include "tool/panel/key_strip.h"

#include <QMouseEvent>
#include <QPainter>

#include <cmath>

namespace lampblack
{

namespace
{
constexpr double Margin = 5;
constexpr double Radius = 3.5;
constexpr double ClickRadius = 5;
} // namespace

KeyStrip::KeyStrip(const QString& name, QWidget* parent) : QWidget(parent)
{
    setObjectName(name);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void KeyStrip::setTime(int frame, int count)
{
    mFrame = frame;
    mCount = qMax(frame, count);
    update();
}

void KeyStrip::setKeys(const QVector<int>& frames)
{
    if (frames == mKeys)
        return;
    mKeys = frames;
    QStringList numbers;
    for (const int frame : frames)
        numbers << QString::number(frame);
    setToolTip(frames.isEmpty() ? tr("No keys: the same at every frame")
                                : tr("Keys at frames %1").arg(numbers.join(QStringLiteral(", "))));
    setAccessibleName(toolTip());
    update();
}

double KeyStrip::xOf(int frame) const
{
    return Margin + (width() - 2 * Margin) * (frame - 1) / qMax(1, mCount - 1);
}

void KeyStrip::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setOpacity(isEnabled() ? 1 : 0.4);
    const double middle = height() / 2.0;
    painter.setPen(QPen(palette().color(QPalette::Mid), 1));
    painter.drawLine(QPointF(xOf(1), middle), QPointF(xOf(mCount), middle));
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
    painter.drawLine(QPointF(xOf(mFrame), 1), QPointF(xOf(mFrame), height() - 1));
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1));
    for (const int frame : mKeys)
    {
        if (frame < 1 || frame > mCount)
            continue;
        painter.setBrush(palette().color(frame == mFrame ? QPalette::Highlight : QPalette::Base));
        painter.drawPolygon(diamond(QPointF(xOf(frame), middle), Radius));
    }
}

void KeyStrip::mousePressEvent(QMouseEvent* event)
{
    if (event->button() != Qt::LeftButton)
        return;
    const double share = (event->localPos().x() - Margin) / qMax(1.0, width() - 2 * Margin);
    int frame = qBound(1, 1 + int(std::lround(share * (mCount - 1))), mCount);
    double nearest = ClickRadius;
    for (const int key : qAsConst(mKeys))
    {
        const double distance = std::abs(xOf(key) - event->localPos().x());
        if (key >= 1 && key <= mCount && distance < nearest)
        {
            nearest = distance;
            frame = key;
        }
    }
    Q_EMIT frameClicked(frame);
}

QPolygonF diamond(const QPointF& centre, double radius)
{
    return QPolygonF({centre - QPointF(0, radius), centre + QPointF(radius, 0), centre + QPointF(0, radius),
                      centre - QPointF(radius, 0)});
}

} // namespace lampblack
