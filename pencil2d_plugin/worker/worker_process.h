// Starts, watches, restarts and ends the worker process.
#pragma once

#include "worker/interpreter.h"
#include "worker/retries.h"
#include "worker/worker_source.h"

#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QTimer>

#include <memory>

namespace lampblack
{

/// Runs `<python> -I -m lampblack serve` in a clean environment, in a private folder for each launch, so that
/// no code from the current folder is run. The folder and all files in it are removed when the process ends.
/// A process that dies is started again: at once, after 1 s, after 3 s. If it dies a fourth time within a
/// minute, it is given up.
class WorkerProcess : public WorkerSource
{
    Q_OBJECT

public:
    explicit WorkerProcess(const Interpreter& interpreter, QObject* parent = nullptr);
    /// Waits for the worker's end, at most 2 s.
    ~WorkerProcess() override;

    bool isRunning() const override { return mRunning; }
    const Interpreter& interpreter() const { return mInterpreter; }
    /// As of the option --device, for processes that are started from now on.
    void setDevice(const QString& device) { mDevice = device; }
    void start() override;
    void stop() override;
    void restart(const QString& reason) override;
    void giveUp(UserError error) override;
    UserError versionMismatch(const QString& details) const override;

    qint64 pid() const { return mProcess == nullptr ? 0 : mProcess->processId(); }
    /// The end of what it wrote to stderr, at most 4 kB.
    QString stderrTail() const { return QString::fromUtf8(mStderrTail); }

private:
    void launch();
    void checkForConnection();
    void readStderr();
    void endProcess();
    void onDied(const QString& reason);

    const Interpreter mInterpreter;
    QString mDevice = QStringLiteral("auto");
    bool mRunning = false; ///< between start() and stop() or gaveUp()
    std::unique_ptr<QTemporaryDir> mFolder;
    QProcess* mProcess = nullptr;
    QByteArray mStderrTail;
    QTimer mConnectionTimer;
    QTimer mRestartTimer;
    QElapsedTimer mSinceLaunch;
    Retries mRetries;
};

} // namespace lampblack
