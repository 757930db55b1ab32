// A number with a name, a slider and a field.
#pragma once

#include "tool/gesture.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QWidget>

namespace lampblack
{

/// The scale of a slider. If `bend` is above 0, small values get more of its length. A `both` slider has 0 in
/// its middle.
struct SliderScale
{
    double least = 0; ///< minimum of the field; the slider starts at `start` or at -end
    double most = 1;  ///< maximum of the field
    double end = 1;   ///< maximum of the slider
    double bend = 0;
    bool both = false;
    int decimals = 2;
    double start = 0; ///< minimum of a slider that is not `both`

    double valueAt(double position) const; ///< position 0..1, or -1..1 if both
    double positionOf(double value) const;
};

/// One line of the panel. A drag of the slider, or steps that follow each other, are one gesture.
class ValueRow : public QWidget
{
    Q_OBJECT

public:
    /// The objectName of the slider is "<name>", that of the field "<name>.field".
    ValueRow(const QString& name, const QString& label, const SliderScale& scale, QWidget* parent = nullptr);

    /// The same for every row of the panel, so that their controls are aligned.
    static int labelWidth(const QFontMetrics& metrics);

    double value() const { return mField->value(); }
    /// Show a value, in or out of the scale; does not emit edited().
    void setValue(double value);
    void setScale(const SliderScale& scale);
    void setSuffix(const QString& suffix) { mField->setSuffix(suffix); }
    void setHint(const QString& hint);

Q_SIGNALS:
    void edited(double value, int gesture);

protected:
    void changeEvent(QEvent* event) override;

private:
    void updateWidths();
    void onSliderMoved(int position);
    void onFieldEdited(double value);
    void showOnSlider(double value);

    SliderScale mScale;
    QLabel* mLabel;
    QSlider* mSlider;
    QDoubleSpinBox* mField;
    GestureSequence mGestures;
    int mSlideGesture = 0; ///< the gesture while the slider is held
};

} // namespace lampblack
