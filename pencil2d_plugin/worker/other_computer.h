// A worker on another machine, which somebody started there with `lampblack serve --listen`.
#pragma once

#include "worker/retries.h"
#include "worker/worker.h"
#include "worker/worker_source.h"

#include <QTimer>

namespace lampblack
{

/// Tells a session how to reach it, again after each loss. It starts and ends nothing there.
class OtherComputer : public WorkerSource
{
    Q_OBJECT

public:
    explicit OtherComputer(const Computer& computer, QObject* parent = nullptr);

    bool isRunning() const override { return mRunning; }
    void start() override;
    void stop() override;
    void restart(const QString& reason) override;
    void giveUp(UserError error) override;
    CurveKeys keys() const override { return mKeys; }
    UserError versionMismatch(const QString& details) const override;

    UserError refused() const;    ///< it does not know our key, or is not the one whose key we have
    UserError notReached() const; ///< nobody answers

private:
    void approach();

    const Computer mComputer;
    CurveKeys mKeys;
    bool mRunning = false;
    QTimer mTimer;
    Retries mRetries;
};

} // namespace lampblack
