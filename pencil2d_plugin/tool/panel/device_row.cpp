#include "tool/panel/device_row.h"

#include "tool/panel/computer_dialog.h"
#include "tool/panel/ignore_wheel.h"

#include <QHBoxLayout>
#include <QLabel>

namespace lampblack
{

namespace
{

const QString Remembered = QStringLiteral("lampblack.panel.device");
const QString RememberedPlace = QStringLiteral("lampblack.panel.elsewhere");
const QString RememberedComputer = QStringLiteral("lampblack.panel.computer");
constexpr int Elsewhere = -1; // other choices have the number of their Device as data

} // namespace

DeviceRow::DeviceRow(Host& host, QWidget* parent) : QWidget(parent), mHost(host), mChoice(new QComboBox(this))
{
    mChoice->setObjectName(Remembered);
    mChoice->setAccessibleName(tr("What computes the light"));
    mChoice->setToolTip(tr("What computes the light: this computer, or a stronger one. "
                           "If the card makes trouble, choose the processor."));
    mChoice->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    mChoice->addItem(tr("This computer"), int(Worker::Device::Auto));
    mChoice->addItem(tr("Another…"), Elsewhere);
    mChoice->setItemData(1, tr("Another computer, on which Lampblack serves"), Qt::ToolTipRole);
    ignoreWheelWithoutFocus(mChoice);
    const bool isCardUsed = host.remembered(Remembered, true).toBool();
    if (!isCardUsed)
        addProcessor();
    if (host.remembered(RememberedPlace, false).toBool())
        choose(mChoice->findData(Elsewhere));
    else if (!isCardUsed)
        choose(mChoice->findData(int(Worker::Device::Processor)));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(new QLabel(tr("Render on"), this));
    row->addWidget(mChoice, 1);
    connect(mChoice, qOverload<int>(&QComboBox::activated), this, &DeviceRow::onActivated);
}

void DeviceRow::onActivated()
{
    if (mChoice->currentData().toInt() == Elsewhere)
    {
        const QStringList before = mHost.remembered(RememberedComputer, QStringList()).toStringList();
        auto* dialog = new ComputerDialog({before.value(0), before.value(1), before.value(2)}, this);
        connect(dialog, &QDialog::accepted, this, [this, dialog] { takeComputer(dialog->computer()); });
        connect(dialog, &QDialog::rejected, this, [this] { choose(mChosen); });
        dialog->open();
        return;
    }
    const bool wasElsewhere = computer().has_value();
    choose(mChoice->currentIndex());
    mHost.remember(Remembered, device() == Worker::Device::Auto);
    mHost.remember(RememberedPlace, false);
    Q_EMIT chosen(device());
    if (wasElsewhere)
        Q_EMIT computerChosen(std::nullopt);
}

void DeviceRow::takeComputer(const Computer& computer)
{
    choose(mChoice->findData(Elsewhere));
    mHost.remember(RememberedPlace, true);
    mHost.remember(RememberedComputer, QStringList{computer.address, computer.key, computer.ownKey});
    Q_EMIT computerChosen(computer);
}

void DeviceRow::choose(int place)
{
    mChosen = place;
    mChoice->setCurrentIndex(place);
}

Worker::Device DeviceRow::device() const
{
    const bool isProcessor = mChoice->itemData(mChosen).toInt() == int(Worker::Device::Processor);
    return isProcessor ? Worker::Device::Processor : Worker::Device::Auto;
}

std::optional<Computer> DeviceRow::computer() const
{
    if (mChoice->itemData(mChosen).toInt() != Elsewhere)
        return std::nullopt;
    const QStringList said = mHost.remembered(RememberedComputer, QStringList()).toStringList();
    return Computer{said.value(0), said.value(1), said.value(2)};
}

void DeviceRow::addProcessor()
{
    if (mChoice->findData(int(Worker::Device::Processor)) >= 0)
        return;
    mChoice->setItemText(0, tr("Card"));
    mChoice->insertItem(1, tr("Processor"), int(Worker::Device::Processor));
    mChosen = mChoice->currentIndex(); // the one after it has moved
}

void DeviceRow::setCard(const QString& name)
{
    // The card of another computer is no choice here.
    if (name.isEmpty() || computer())
        return;
    addProcessor();
    mChoice->setItemData(0, name, Qt::ToolTipRole);
}

} // namespace lampblack
