#include "tool/panel/place_row.h"

#include "tool/panel/ignore_wheel.h"
#include "tool/panel/value_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>

namespace lampblack
{

namespace
{
constexpr double Far = 99999;
constexpr double Step = 10;
} // namespace

PlaceRow::PlaceRow(const QString& name, const QString& label, QWidget* parent)
    : QWidget(parent), mLabel(new QLabel(label, this))
{
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    mLabel->setFixedWidth(ValueRow::labelWidth(fontMetrics()));
    row->addWidget(mLabel);
    mX = addField(name + QStringLiteral(".x"), tr("From the left edge, in pixels of the canvas"));
    mY = addField(name + QStringLiteral(".y"), tr("From the top edge, in pixels of the canvas"));
}

QDoubleSpinBox* PlaceRow::addField(const QString& name, const QString& label)
{
    auto* field = new QDoubleSpinBox(this);
    field->setObjectName(name);
    field->setAccessibleName(label);
    field->setToolTip(label);
    field->setRange(-Far, Far);
    field->setDecimals(0);
    field->setSingleStep(Step);
    field->setButtonSymbols(QAbstractSpinBox::NoButtons);
    field->setAlignment(Qt::AlignRight);
    field->setKeyboardTracking(false);
    field->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    // Ctrl+Z in the field undoes a change of the scene, see KeyInput.
    field->findChild<QLineEdit*>()->setProperty("lampblack.value", true);
    field->setProperty("lampblack.value", true);
    ignoreWheelWithoutFocus(field);
    layout()->addWidget(field);
    connect(field, qOverload<double>(&QDoubleSpinBox::valueChanged), this,
            [this, field](double value)
            {
                (field == mX ? mPlace.rx() : mPlace.ry()) = value;
                Q_EMIT edited(mPlace, mGestures.gestureFor(field->objectName()));
            });
    return field;
}

void PlaceRow::changeEvent(QEvent* event)
{
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange)
        mLabel->setFixedWidth(ValueRow::labelWidth(fontMetrics()));
    QWidget::changeEvent(event);
}

void PlaceRow::setPlace(const QPointF& place)
{
    const QSignalBlocker left(mX);
    const QSignalBlocker top(mY);
    mPlace = place;
    mX->setValue(place.x());
    mY->setValue(place.y());
}

} // namespace lampblack
