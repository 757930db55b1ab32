// Where a session has its worker from: a process on this machine, or another machine.
#pragma once

#include "user_error.h"
#include "worker/curve_keys.h"

#include <QObject>

namespace lampblack
{

class WorkerSource : public QObject
{
    Q_OBJECT

public:
    using QObject::QObject;

    /// Between start() and stop() or gaveUp().
    virtual bool isRunning() const = 0;
    virtual void start() = 0;
    virtual void stop() = 0;
    /// The worker is of no more use: leave it, and get another. `reason` is for the details of an error.
    virtual void restart(const QString& reason) = 0;
    /// Leave the worker, get no other, and emit gaveUp(). start() tries again.
    virtual void giveUp(UserError error) = 0;

    /// For a worker that is reached over a network; empty for one on this machine.
    virtual CurveKeys keys() const { return {}; }
    /// What is said when plugin and worker do not speak the same protocol.
    virtual UserError versionMismatch(const QString& details) const = 0;

Q_SIGNALS:
    void ready(const QString& endpoint); ///< clients can connect
    void lost();                         ///< the worker is gone; another is being got
    void gaveUp(const lampblack::UserError& error);
};

} // namespace lampblack
