// The choice of what computes the light: this computer's card or processor, or another computer.
#pragma once

#include "host/host.h"
#include "worker/worker.h"

#include <QComboBox>

#include <optional>

namespace lampblack
{

/// Card and processor are two choices only after the worker has found a card, or when the artist had turned
/// one away. The choice is kept between sessions, of all projects.
class DeviceRow : public QWidget
{
    Q_OBJECT

public:
    explicit DeviceRow(Host& host, QWidget* parent = nullptr);

    Worker::Device device() const;
    /// The other computer that is to work; no value: this one.
    std::optional<Computer> computer() const;
    /// The graphics card that the worker uses; an empty name is ignored.
    void setCard(const QString& name);

Q_SIGNALS:
    void chosen(lampblack::Worker::Device device);
    void computerChosen(const std::optional<lampblack::Computer>& computer);

private:
    void onActivated();
    void addProcessor();
    void choose(int place);
    void takeComputer(const Computer& computer);

    Host& mHost;
    QComboBox* mChoice;
    int mChosen = 0; ///< the place of the choice that is in force
};

} // namespace lampblack
