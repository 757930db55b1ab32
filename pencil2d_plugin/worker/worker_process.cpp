#include "worker/worker_process.h"

#include "protocol/connection.h"
#include "protocol/messages.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QProcessEnvironment>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int LookMs = 50;
constexpr int StartMs = 60000; // importing the network's library from a cold disk is slow
constexpr int EndMs = 2000;
constexpr int PausesMs[] = {0, 1000, 3000};
constexpr int MostDeaths = 4;
constexpr qint64 MinuteMs = 60000;
constexpr int MostWords = 4096;

/// What a worker needs of ours, and nothing that would bend its Python or its libraries.
QProcessEnvironment cleanEnvironment(const QString& folder)
{
    static const QStringList kept = {QStringLiteral("HOME"), QStringLiteral("PATH"),
                                     QStringLiteral("USER"), QStringLiteral("LOGNAME"),
                                     QStringLiteral("LANG"), QStringLiteral("LANGUAGE")};
    static const QStringList keptBeginnings = {QStringLiteral("LC_"), QStringLiteral("XDG_"),
                                               QStringLiteral("LAMPBLACK_")};
    const QProcessEnvironment ours = QProcessEnvironment::systemEnvironment();
    QProcessEnvironment clean;
    const QStringList names = ours.keys();
    for (const QString& name : names)
    {
        const auto begins = [&name](const QString& beginning)
        {
            return name.startsWith(beginning);
        };
        if (kept.contains(name) || std::any_of(keptBeginnings.begin(), keptBeginnings.end(), begins))
        {
            clean.insert(name, ours.value(name));
        }
    }
    // So that its socket and whatever else it leaves when it is killed goes with our folder.
    clean.insert(QStringLiteral("TMPDIR"), folder);
    clean.remove(QStringLiteral("XDG_RUNTIME_DIR"));
    return clean;
}

} // namespace

WorkerProcess::WorkerProcess(const Interpreter& interpreter, QObject* parent)
    : QObject(parent), mInterpreter(interpreter)
{
    mClock.start();
    mLooking.setInterval(LookMs);
    mPause.setSingleShot(true);
    connect(&mLooking, &QTimer::timeout, this, &WorkerProcess::lookForConnection);
    connect(&mPause, &QTimer::timeout, this, &WorkerProcess::launch);
}

WorkerProcess::~WorkerProcess()
{
    stop();
    // Also those that were replaced a moment ago.
    const auto leaving = findChildren<QProcess*>();
    for (QProcess* process : leaving)
    {
        process->disconnect();
        if (!process->waitForFinished(EndMs))
        {
            process->kill();
            process->waitForFinished(EndMs);
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
    mDeaths.clear();
    mPause.start(0);
}

void WorkerProcess::stop()
{
    mRunning = false;
    mPause.stop();
    dispose();
}

void WorkerProcess::replace(const QString& why)
{
    if (mRunning && mProcess != nullptr)
    {
        died(why);
    }
}

void WorkerProcess::giveUp(const UserError& error)
{
    stop();
    Q_EMIT gaveUp(error);
}

void WorkerProcess::launch()
{
    const QFileInfo python(mInterpreter.path);
    if (mInterpreter.path.isEmpty() || !python.isFile() || !python.isExecutable())
    {
        giveUp(notInstalled(mInterpreter, QStringLiteral("There is no such program.")));
        return;
    }
    mFolder = std::make_unique<QTemporaryDir>(QDir::tempPath() + QStringLiteral("/lampblack-XXXXXX"));
    if (!mFolder->isValid())
    {
        giveUp({tr("Lampblack's worker could not be started."),
                tr("Make room in %1, then start Pencil2D again.").arg(QDir::tempPath()),
                mFolder->errorString()});
        return;
    }
    mLastWords.clear();
    mProcess = new QProcess(this);
    mProcess->setProcessEnvironment(cleanEnvironment(mFolder->path()));
    // Pencil2D's own folder may be a downloaded project: nothing in it is to be loaded.
    mProcess->setWorkingDirectory(mFolder->path());
    mProcess->setStandardInputFile(QProcess::nullDevice());
    mProcess->setStandardOutputFile(QProcess::nullDevice());
    connect(mProcess, &QProcess::readyReadStandardError, this, &WorkerProcess::listen);
    connect(mProcess, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
            [this](int code, QProcess::ExitStatus status)
            {
                died(status == QProcess::CrashExit ? QStringLiteral("It was ended by signal %1.").arg(code)
                                                   : QStringLiteral("It ended with code %1.").arg(code));
            });
    connect(mProcess, &QProcess::errorOccurred, this,
            [this](QProcess::ProcessError error)
            {
                if (error == QProcess::FailedToStart)
                {
                    died(mProcess->errorString());
                }
            });
    mLaunched.start();
    mLooking.start();
    mProcess->start(mInterpreter.path,
                    {QStringLiteral("-I"), QStringLiteral("-m"), QStringLiteral("lampblack"),
                     QStringLiteral("serve"), QStringLiteral("--connection"),
                     mFolder->filePath(QStringLiteral("connection.json")), QStringLiteral("--parent-pid"),
                     QString::number(QCoreApplication::applicationPid())});
}

void WorkerProcess::lookForConnection()
{
    const QString path = mFolder->filePath(QStringLiteral("connection.json"));
    if (!QFile::exists(path))
    {
        if (mLaunched.hasExpired(StartMs))
        {
            died(QStringLiteral("It was not ready after %1 s.").arg(StartMs / 1000));
        }
        return;
    }
    mLooking.stop();
    QString fault;
    const std::optional<protocol::Connection> connection = protocol::readConnection(path, &fault);
    if (!connection)
    {
        died(fault);
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

void WorkerProcess::listen()
{
    mLastWords = (mLastWords + mProcess->readAllStandardError()).right(MostWords);
}

void WorkerProcess::dispose()
{
    mLooking.stop();
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
        QTimer::singleShot(EndMs, process, &QProcess::kill);
        if (process->state() == QProcess::Starting)
        {
            process->kill(); // still a copy of our own program, with its signal handlers
        }
        else
        {
            process->terminate();
        }
    }
    mFolder.reset();
}

void WorkerProcess::died(const QString& how)
{
    listen();
    dispose();
    const qint64 now = mClock.elapsed();
    mDeaths.append(now);
    const auto old = [now](qint64 death)
    {
        return death < now - MinuteMs;
    };
    mDeaths.erase(std::remove_if(mDeaths.begin(), mDeaths.end(), old), mDeaths.end());
    if (mLastWords.contains("No module named lampblack"))
    {
        giveUp(notInstalled(mInterpreter, lastWords()));
    }
    else if (mDeaths.size() >= MostDeaths)
    {
        giveUp({tr("Lampblack's worker ended %1 times within a minute.").arg(mDeaths.size()),
                tr("Open a terminal and type: %1 -I -m lampblack doctor").arg(mInterpreter.path),
                how + QLatin1Char('\n') + lastWords()});
    }
    else
    {
        Q_EMIT lost();
        if (mRunning)
        {
            mPause.start(PausesMs[mDeaths.size() - 1]);
        }
    }
}

} // namespace lampblack
