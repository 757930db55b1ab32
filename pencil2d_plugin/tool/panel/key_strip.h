// Where on the timeline the keys are.
#pragma once

#include <QVector>
#include <QWidget>

namespace lampblack
{

/// A line along the animation with a diamond at each key and a mark at the current frame. A click asks for
/// the frame there, a key's if one is near.
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
    void picked(int frame);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

private:
    double at(int frame) const; ///< from the left, pixels

    int mFrame = 1;
    int mCount = 1;
    QVector<int> mKeys;
};

/// A key as people know it from timelines, around `centre`.
QPolygonF diamond(const QPointF& centre, double radius);

} // namespace lampblack
