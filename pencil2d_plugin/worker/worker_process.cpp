#include "worker/worker_process.h"

#include "own_folder.h"
#include "protocol/connection.h"
#include "protocol/messages.h"
#include "worker/clean_environment.h"

#include <QCoreApplication>
#include <QDir>

#ifdef Q_OS_LINUX
#include <csignal>
#include <sys/prctl.h>
#endif

namespace lampblack
{

namespace
{

constexpr int ConnectionCheckMs = 50;
constexpr int StartTimeoutMs = 60000; // importing the network's library from a cold disk is slow
constexpr int EndTimeoutMs = 2000;
constexpr int MaxStderrBytes = 4096;

/// A process that goes on if it is stopped when this one ends: only then can it see that, and end too.
class Child : public QProcess
{
public:
    using QProcess::QProcess;

protected:
    void setupChildProcess() override
    {
#ifdef Q_OS_LINUX
        prctl(PR_SET_PDEATHSIG, SIGCONT);
#endif
    }
};

} // namespace

WorkerProcess::WorkerProcess(const Interpreter& interpreter, QObject* parent)
    : WorkerSource(parent), mInterpreter(interpreter)
{
    mConnectionTimer.setInterval(ConnectionCheckMs);
    mRestartTimer.setSingleShot(true);
    connect(&mConnectionTimer, &QTimer::timeout, this, &WorkerProcess::checkForConnection);
    connect(&mRestartTimer, &QTimer::timeout, this, &WorkerProcess::launch);
}

WorkerProcess::~WorkerProcess()
{
    stop();
    // Also wait for processes that stop() and restart() have only asked to end.
    const auto processes = findChildren<QProcess*>();
    for (QProcess* process : processes)
    {
        process->disconnect();
        if (!process->waitForFinished(EndTimeoutMs))
        {
            process->kill();
            process->waitForFinished(EndTimeoutMs);
        }
    }
}

void WorkerProcess::start()
{
    if (mRunning)
    {
        return;
    }
    mRunning = true;
    mRetries.forget();
    mRestartTimer.start(0);
}

void WorkerProcess::stop()
{
    mRunning = false;
    mRestartTimer.stop();
    endProcess();
}

void WorkerProcess::restart(const QString& reason)
{
    if (mRunning && mProcess != nullptr)
    {
        onDied(reason);
    }
}

void WorkerProcess::giveUp(UserError error)
{
    stop();
    error.kind = UserError::Kind::NoWorker;
    Q_EMIT gaveUp(error);
}

UserError WorkerProcess::versionMismatch(const QString& details) const
{
    return lampblack::versionMismatch(mInterpreter, details);
}

void WorkerProcess::launch()
{
    if (const std::optional<UserError> error = whyUnusable(mInterpreter))
    {
        giveUp(*error);
        return;
    }
    mFolder = std::make_unique<QTemporaryDir>(ownFolderTemplate());
    if (!mFolder->isValid())
    {
        giveUp({tr("The renderer could not be started."),
                tr("Make room in %1, then try again.").arg(QDir::tempPath()), mFolder->errorString()});
        return;
    }
    mStderrTail.clear();
    mProcess = new Child(this);
    mProcess->setProcessEnvironment(cleanEnvironment(mFolder->path()));
    // Pencil2D's own folder may be a downloaded project: nothing in it is to be loaded.
    mProcess->setWorkingDirectory(mFolder->path());
    mProcess->setStandardInputFile(QProcess::nullDevice());
    mProcess->setStandardOutputFile(QProcess::nullDevice());
    connect(mProcess, &QProcess::readyReadStandardError, this, &WorkerProcess::readStderr);
    connect(mProcess, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
            [this](int code, QProcess::ExitStatus status)
            {
                onDied(status == QProcess::CrashExit ? QStringLiteral("It was ended by signal %1.").arg(code)
                                                     : QStringLiteral("It ended with code %1.").arg(code));
            });
    connect(mProcess, &QProcess::errorOccurred, this,
            [this](QProcess::ProcessError error)
            {
                if (error == QProcess::FailedToStart)
                {
                    onDied(mProcess->errorString());
                }
            });
    mSinceLaunch.start();
    mConnectionTimer.start();
    mProcess->start(mInterpreter.path,
                    {QStringLiteral("-I"), QStringLiteral("-m"), QStringLiteral("lampblack"),
                     QStringLiteral("serve"), QStringLiteral("--connection"),
                     mFolder->filePath(QStringLiteral("connection.json")), QStringLiteral("--parent-pid"),
                     QString::number(QCoreApplication::applicationPid()), QStringLiteral("--device"),
                     mDevice});
}

void WorkerProcess::checkForConnection()
{
    const QString path = mFolder->filePath(QStringLiteral("connection.json"));
    if (!QFile::exists(path))
    {
        if (mSinceLaunch.hasExpired(StartTimeoutMs))
        {
            onDied(QStringLiteral("It was not ready after %1 s.").arg(StartTimeoutMs / 1000));
        }
        return;
    }
    mConnectionTimer.stop();
    QString fault;
    const std::optional<protocol::Connection> connection = protocol::readConnection(path, &fault);
    if (!connection)
    {
        onDied(fault);
    }
    else if (connection->lampblack != protocol::Major)
    {
        giveUp(versionMismatch(
            QStringLiteral("The worker speaks version %1, the plugin version %2 of the protocol.")
                .arg(connection->lampblack)
                .arg(protocol::Major)));
    }
    else
    {
        Q_EMIT ready(connection->endpoint);
    }
}

void WorkerProcess::readStderr()
{
    mStderrTail = (mStderrTail + mProcess->readAllStandardError()).right(MaxStderrBytes);
}

void WorkerProcess::endProcess()
{
    mConnectionTimer.stop();
    if (mProcess == nullptr)
    {
        return;
    }
    QProcess* process = std::exchange(mProcess, nullptr);
    process->disconnect();
    if (process->state() == QProcess::NotRunning)
    {
        process->deleteLater();
    }
    else
    {
        connect(process, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), process,
                &QObject::deleteLater);
        QTimer::singleShot(EndTimeoutMs, process, &QProcess::kill);
        if (process->state() == QProcess::Starting)
        {
            process->kill(); // not terminate(): before exec it still has our signal handlers
        }
        else
        {
            process->terminate();
        }
    }
    mFolder.reset();
}

void WorkerProcess::onDied(const QString& reason)
{
    readStderr();
    endProcess();
    const std::optional<int> delay = mRetries.delayAfterFailure();
    if (mStderrTail.contains("No module named lampblack"))
    {
        giveUp(notInstalled(mInterpreter, stderrTail()));
    }
    else if (!delay)
    {
        giveUp({tr("The renderer stopped %1 times within a minute.").arg(mRetries.failures()),
                tr("Open a terminal and type: %1 -I -m lampblack doctor").arg(mInterpreter.path),
                reason + QLatin1Char('\n') + stderrTail()});
    }
    else
    {
        Q_EMIT lost();
        if (mRunning)
        {
            mRestartTimer.start(*delay);
        }
    }
}

} // namespace lampblack
