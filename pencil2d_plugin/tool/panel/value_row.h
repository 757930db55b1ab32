// A named number with a slider and a field.
#pragma once

#include "tool/gesture.h"

#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QWidget>

namespace lampblack
{

/// How a slider spreads its values. Small values get more of it when `bend` is above 0; a `both`
/// slider has 0 in its middle.
struct SliderScale
{
    double least = 0; ///< of the field; the slider starts at 0 or at -end
    double most = 1;  ///< of the field
    double end = 1;   ///< of the slider; the field may go on
    double bend = 0;
    bool both = false;
    int decimals = 2;

    double valueAt(double position) const; ///< position 0..1, or -1..1 if both
    double positionOf(double value) const;
};

/// One line: name, slider, field. Steps that follow each other and a whole drag are one gesture.
class ValueRow : public QWidget
{
    Q_OBJECT

public:
    /// `name` ends the objectNames: "<name>" of the slider, "<name>.field" of the field.
    ValueRow(const QString& name, const QString& label, const SliderScale& scale, QWidget* parent = nullptr);

    /// Of every row of the panel: their controls stand in line.
    static int labelWidth(const QFontMetrics& metrics);

    double value() const { return mField->value(); }
    /// Show a value; tells nobody.
    void setValue(double value);
    void setScale(const SliderScale& scale);
    void setSuffix(const QString& suffix) { mField->setSuffix(suffix); }
    void setHint(const QString& hint);

Q_SIGNALS:
    void edited(double value, int gesture);

protected:
    void changeEvent(QEvent* event) override;

private:
    void align();
    void slid(int position);
    void typed(double value);
    void showOnSlider(double value);

    SliderScale mScale;
    QLabel* mLabel;
    QSlider* mSlider;
    QDoubleSpinBox* mField;
    GestureRun mRun;
    int mSlide = 0; ///< the gesture while the slider is held
};

} // namespace lampblack
