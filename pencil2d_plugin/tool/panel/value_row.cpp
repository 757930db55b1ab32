#include "tool/panel/value_row.h"

#include "tool/panel/ignore_wheel.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>

namespace lampblack
{

namespace
{
constexpr int Steps = 1000;
constexpr int MinSliderWidth = 30;
} // namespace

double SliderScale::valueAt(double position) const
{
    const double distance = std::abs(position);
    const double share = bend > 0 ? std::expm1(bend * distance) / std::expm1(bend) : distance;
    if (both)
        return std::clamp(std::copysign(share * end, position), least, most);
    return std::clamp(start + share * (end - start), least, most);
}

double SliderScale::positionOf(double value) const
{
    const double way = both ? std::abs(value) / end : (value - start) / (end - start);
    const double share = std::clamp(way, 0.0, 1.0);
    const double position = bend > 0 ? std::log1p(share * std::expm1(bend)) / bend : share;
    return both ? std::copysign(position, value) : position;
}

ValueRow::ValueRow(const QString& name, const QString& label, const SliderScale& scale, QWidget* parent)
    : QWidget(parent), mLabel(new QLabel(label, this)), mSlider(new QSlider(Qt::Horizontal, this)),
      mField(new QDoubleSpinBox(this))
{
    setObjectName(name + QStringLiteral(".row"));
    mSlider->setObjectName(name);
    mSlider->setMinimumWidth(MinSliderWidth);
    mSlider->setAccessibleName(label);
    mField->setObjectName(name + QStringLiteral(".field"));
    mField->setAccessibleName(label);
    mField->setButtonSymbols(QAbstractSpinBox::NoButtons);
    mField->setAlignment(Qt::AlignRight);
    mField->setKeyboardTracking(false);
    // Ctrl+Z in the field undoes a change of the scene, see KeyInput.
    mField->findChild<QLineEdit*>()->setProperty("lampblack.value", true);
    mField->setProperty("lampblack.value", true);
    mLabel->setBuddy(mField);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(mLabel);
    row->addWidget(mSlider, 1);
    row->addWidget(mField);
    ignoreWheelWithoutFocus(mSlider);
    ignoreWheelWithoutFocus(mField);
    setScale(scale);
    updateWidths();
    connect(mSlider, &QSlider::sliderPressed, this, [this] { mSlideGesture = newGesture(); });
    connect(mSlider, &QSlider::sliderReleased, this, [this] { mSlideGesture = 0; });
    connect(mSlider, &QSlider::valueChanged, this, &ValueRow::onSliderMoved);
    connect(mField, qOverload<double>(&QDoubleSpinBox::valueChanged), this, &ValueRow::onFieldEdited);
}

void ValueRow::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange)
        updateWidths();
    QWidget::changeEvent(event);
}

int ValueRow::labelWidth(const QFontMetrics& metrics)
{
    return metrics.horizontalAdvance(tr("Roughness")) + 2;
}

void ValueRow::updateWidths()
{
    const QFontMetrics metrics = fontMetrics();
    mLabel->setFixedWidth(labelWidth(metrics));
    mField->setFixedWidth(metrics.horizontalAdvance(QStringLiteral("-8888")) + 14);
}

void ValueRow::setScale(const SliderScale& scale)
{
    const QSignalBlocker sliderBlocker(mSlider);
    const QSignalBlocker fieldBlocker(mField);
    const double shown = mField->value();
    mScale = scale;
    mSlider->setRange(scale.both ? -Steps : 0, Steps);
    mSlider->setPageStep(Steps / 10);
    mSlider->setSingleStep(Steps / 100);
    mField->setDecimals(scale.decimals);
    mField->setSingleStep(scale.end / 20);
    setValue(shown);
}

void ValueRow::setValue(double value)
{
    const QSignalBlocker blocker(mField);
    mField->setRange(std::min(mScale.least, value), std::max(mScale.most, value));
    mField->setValue(value);
    showOnSlider(value);
}

void ValueRow::setHint(const QString& hint)
{
    setToolTip(hint);
    mSlider->setAccessibleDescription(hint);
    mField->setAccessibleDescription(hint);
}

void ValueRow::onSliderMoved(int position)
{
    const double value = mScale.valueAt(double(position) / Steps);
    const double rounding = std::pow(10, mScale.decimals);
    const double shown = std::round(value * rounding) / rounding;
    {
        const QSignalBlocker blocker(mField);
        mField->setValue(shown);
    }
    Q_EMIT edited(shown, mSlideGesture ? mSlideGesture : mGestures.gestureFor(objectName()));
}

void ValueRow::onFieldEdited(double value)
{
    showOnSlider(value);
    Q_EMIT edited(value, mGestures.gestureFor(objectName()));
}

void ValueRow::showOnSlider(double value)
{
    if (mSlider->isSliderDown())
        return;
    const QSignalBlocker blocker(mSlider);
    mSlider->setValue(int(std::lround(mScale.positionOf(value) * Steps)));
}

} // namespace lampblack
