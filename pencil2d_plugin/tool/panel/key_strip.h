// Shows the keys of a light or the floor along the animation.
#pragma once

#include <QVector>
#include <QWidget>

namespace lampblack
{

/// A line with a diamond at each key and a mark at the current frame. A click emits the frame there, or that
/// of a key nearby.
class KeyStrip : public QWidget
{
    Q_OBJECT

public:
    explicit KeyStrip(const QString& name, QWidget* parent = nullptr);

    /// Frames 1 to `count`; keys beyond are not shown.
    void setTime(int frame, int count);
    void setKeys(const QVector<int>& frames);

    QSize sizeHint() const override { return {80, 16}; }
    QSize minimumSizeHint() const override { return {30, 16}; }

Q_SIGNALS:
    void frameClicked(int frame);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

private:
    double xOf(int frame) const; ///< from the left, pixels

    int mFrame = 1;
    int mCount = 1;
    QVector<int> mKeys;
};

/// The usual symbol of a key in timelines, around `centre`.
QPolygonF diamond(const QPointF& centre, double radius);

} // namespace lampblack
