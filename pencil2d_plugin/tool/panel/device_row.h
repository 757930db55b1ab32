// The choice between a graphics card and the processor.
#pragma once

#include "host/host.h"
#include "worker/worker.h"

#include <QComboBox>

namespace lampblack
{

/// Hidden until there is something to choose: the worker has found a card, or the artist had turned one away.
/// The choice is kept between sessions, of all projects.
class DeviceRow : public QWidget
{
    Q_OBJECT

public:
    explicit DeviceRow(Host& host, QWidget* parent = nullptr);

    Worker::Device device() const;
    /// The graphics card that the worker uses; an empty name is ignored.
    void setCard(const QString& name);

Q_SIGNALS:
    void chosen(lampblack::Worker::Device device);

private:
    QComboBox* mChoice;
};

} // namespace lampblack
