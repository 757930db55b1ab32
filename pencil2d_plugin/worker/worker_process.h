// Starts, watches, restarts and ends the worker process.
#pragma once

#include "user_error.h"
#include "worker/interpreter.h"

#include <QElapsedTimer>
#include <QObject>
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
class WorkerProcess : public QObject
{
    Q_OBJECT

public:
    explicit WorkerProcess(const Interpreter& interpreter, QObject* parent = nullptr);
    /// Waits for the worker's end, at most 2 s.
    ~WorkerProcess() override;

    bool isRunning() const { return mRunning; }
    const Interpreter& interpreter() const { return mInterpreter; }
    /// As of the option --device, for processes that are started from now on.
    void setDevice(const QString& device) { mDevice = device; }
    void start();
    void stop();
    /// End a process that is of no more use, and start another. `reason` is for the details of an error.
    void restart(const QString& reason);
    /// End the process, start no other, and emit gaveUp(). start() tries again.
    void giveUp(UserError error);

    qint64 pid() const { return mProcess == nullptr ? 0 : mProcess->processId(); }
    /// The end of what it wrote to stderr, at most 4 kB.
    QString stderrTail() const { return QString::fromUtf8(mStderrTail); }

Q_SIGNALS:
    void ready(const QString& endpoint); ///< clients can connect
    void lost();                         ///< the process has ended; another is being started
    void gaveUp(const lampblack::UserError& error);

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
    QElapsedTimer mClock;
    QVector<qint64> mDeaths; ///< times by mClock, of the last minute
};

} // namespace lampblack
