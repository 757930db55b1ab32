// The worker's process: started, watched, started again, ended.
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

/// Runs `<python> -I -m lampblack serve` in a clean environment and in a private folder of each launch, so
/// that no code of the current folder is run. Whatever it leaves lies there and goes with it. When it dies it
/// is started again: at once, after 1 s, after 3 s; dying a fourth time within a minute it is given up.
class WorkerProcess : public QObject
{
    Q_OBJECT

public:
    explicit WorkerProcess(const Interpreter& interpreter, QObject* parent = nullptr);
    /// Waits for the worker's end, at most 2 s.
    ~WorkerProcess() override;

    bool isRunning() const { return mRunning; }
    void start();
    void stop();
    /// It runs, but is of no use any more (`why`, for the details): end it and start another.
    void replace(const QString& why);
    /// Start none any more, and tell.
    void giveUp(const UserError& error);

    qint64 pid() const { return mProcess == nullptr ? 0 : mProcess->processId(); }
    /// The end of what it wrote to stderr, at most 4 kB.
    QString lastWords() const { return QString::fromUtf8(mLastWords); }

Q_SIGNALS:
    void ready(const QString& endpoint); ///< it can be connected to
    void lost();                         ///< it is gone; another is started by itself
    void gaveUp(const lampblack::UserError& error);

private:
    void launch();
    void lookForConnection();
    void listen();
    void dispose();
    void died(const QString& how);

    const Interpreter mInterpreter;
    bool mRunning = false; ///< between start() and stop() or gaveUp()
    std::unique_ptr<QTemporaryDir> mFolder;
    QProcess* mProcess = nullptr;
    QByteArray mLastWords;
    QTimer mLooking;
    QTimer mPause;
    QElapsedTimer mLaunched;
    QElapsedTimer mClock;
    QVector<qint64> mDeaths; ///< by mClock, of the last minute
};

} // namespace lampblack
