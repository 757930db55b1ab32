// A place on the canvas, as two numbers.
#pragma once

#include "tool/gesture.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QWidget>

namespace lampblack
{

/// One line of the panel: x from the left, y from the top, canvas pixels.
class PlaceRow : public QWidget
{
    Q_OBJECT

public:
    /// The objectNames of the fields are "<name>.x" and "<name>.y".
    PlaceRow(const QString& name, const QString& label, QWidget* parent = nullptr);

    /// Show a place; does not emit edited().
    void setPlace(const QPointF& place);

Q_SIGNALS:
    void edited(const QPointF& place, int gesture);

protected:
    void changeEvent(QEvent* event) override;

private:
    QDoubleSpinBox* addField(const QString& name, const QString& label);

    QLabel* mLabel;
    QDoubleSpinBox* mX;
    QDoubleSpinBox* mY;
    QPointF mPlace; ///< exact, where the fields are rounded
    GestureSequence mGestures;
};

} // namespace lampblack
