#include "tool/panel/device_row.h"

#include "tool/panel/ignore_wheel.h"

#include <QHBoxLayout>
#include <QLabel>

namespace lampblack
{

namespace
{
const QString Remembered = QStringLiteral("lampblack.panel.device");
}

DeviceRow::DeviceRow(Host& host, QWidget* parent) : QWidget(parent), mChoice(new QComboBox(this))
{
    mChoice->setObjectName(Remembered);
    mChoice->setAccessibleName(tr("What computes the light"));
    mChoice->setToolTip(tr("What computes the light. If the card makes trouble, choose the processor."));
    mChoice->addItem(tr("Card"), int(Worker::Device::Auto));
    mChoice->addItem(tr("Processor"), int(Worker::Device::Processor));
    ignoreWheelWithoutFocus(mChoice);
    const bool isCardUsed = host.remembered(Remembered, true).toBool();
    mChoice->setCurrentIndex(isCardUsed ? 0 : 1);
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(new QLabel(tr("Render on"), this), 1);
    row->addWidget(mChoice);
    if (isCardUsed)
        hide();
    connect(mChoice, qOverload<int>(&QComboBox::activated), this,
            [this, &host]
            {
                host.remember(Remembered, device() == Worker::Device::Auto);
                Q_EMIT chosen(device());
            });
}

Worker::Device DeviceRow::device() const
{
    return static_cast<Worker::Device>(mChoice->currentData().toInt());
}

void DeviceRow::setCard(const QString& name)
{
    if (name.isEmpty())
        return;
    mChoice->setItemData(0, name, Qt::ToolTipRole);
    setVisible(true);
}

} // namespace lampblack
