#include "worker/installer.h"

#include <QDir>
#include <QFileInfo>
#include <QJsonDocument>
#include <QProcessEnvironment>
#include <QStandardPaths>

namespace lampblack
{

namespace
{

constexpr int EndTimeoutMs = 2000;
constexpr qint64 MaxLineBytes = 1 << 16;

/// The system's Python: what Pencil2D's own environment names may be another.
QString systemPython()
{
    for (const char* name : {"/usr/bin/python3", "/usr/local/bin/python3"})
    {
        if (QFileInfo(QString::fromLatin1(name)).isExecutable())
            return QString::fromLatin1(name);
    }
    return QStringLiteral("python3");
}

InstallPlan::State stateOf(const QString& name)
{
    if (name == QLatin1String("half"))
        return InstallPlan::State::Half;
    if (name == QLatin1String("other"))
        return InstallPlan::State::Other;
    return name == QLatin1String("installed") ? InstallPlan::State::Installed : InstallPlan::State::Absent;
}

qint64 bytes(const QJsonObject& told, const char* name)
{
    return qint64(told.value(QLatin1String(name)).toDouble());
}

QString text(const QJsonObject& told, const char* name)
{
    return told.value(QLatin1String(name)).toString();
}

} // namespace

QString dataFolder()
{
    return QDir(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation))
        .filePath(QStringLiteral("lampblack"));
}

Installer::Installer(const QString& source, QObject* parent) : QObject(parent), mSource(source)
{
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    for (const char* name : {"PYTHONHOME", "PYTHONPATH", "LD_LIBRARY_PATH", "LD_PRELOAD"})
        environment.remove(QString::fromLatin1(name));
    mProcess.setProcessEnvironment(environment);
    mProcess.setWorkingDirectory(QDir::rootPath());
    mProcess.setProcessChannelMode(QProcess::SeparateChannels);
    connect(&mProcess, &QProcess::readyReadStandardOutput, this, &Installer::read);
    connect(&mProcess, qOverload<int, QProcess::ExitStatus>(&QProcess::finished), this,
            &Installer::onFinished);
    connect(&mProcess, &QProcess::errorOccurred, this,
            [this](QProcess::ProcessError error)
            {
                if (error == QProcess::FailedToStart)
                    onFinished(1, QProcess::CrashExit);
            });
}

Installer::~Installer()
{
    mProcess.disconnect(this);
    cancel();
    if (isRunning() && !mProcess.waitForFinished(EndTimeoutMs))
        mProcess.kill();
}

void Installer::plan()
{
    start(QStringLiteral("plan"));
}

void Installer::install(const QString& wheels)
{
    start(QStringLiteral("install"), wheels);
}

void Installer::remove()
{
    start(QStringLiteral("remove"));
}

void Installer::cancel()
{
    mCancelled = true;
    if (isRunning())
        mProcess.terminate();
}

void Installer::start(const QString& what, const QString& wheels)
{
    if (isRunning())
        return;
    mCancelled = false;
    mPlan = mOutcome = {};
    mDoing = what;
    QStringList words{QStringLiteral("-I"),
                      QDir(mSource).filePath(QStringLiteral("install_worker.py")),
                      what,
                      QStringLiteral("--from"),
                      mSource,
                      QStringLiteral("--to"),
                      dataFolder(),
                      QStringLiteral("--with-parent")};
    if (!wheels.isEmpty())
        words << QStringLiteral("--wheels") << wheels;
    mProcess.start(systemPython(), words);
}

void Installer::read()
{
    while (mProcess.canReadLine())
    {
        const QJsonObject told = QJsonDocument::fromJson(mProcess.readLine(MaxLineBytes)).object();
        const QString say = text(told, "say");
        if (say == QLatin1String("progress"))
            Q_EMIT progressed(text(told, "what"), bytes(told, "done"), bytes(told, "total"));
        else if (say == QLatin1String("plan"))
            mPlan = told;
        else if (!say.isEmpty())
            mOutcome = told;
    }
}

void Installer::onFinished(int code, QProcess::ExitStatus status)
{
    read();
    const QString outcome = text(mOutcome, "say");
    if (outcome == QLatin1String("done") && mDoing == QLatin1String("plan"))
    {
        Q_EMIT planned({stateOf(text(mPlan, "state")), text(mPlan, "version"), text(mPlan, "folder"),
                        bytes(mPlan, "download"), bytes(mPlan, "disk")});
    }
    else if (outcome == QLatin1String("error"))
        Q_EMIT failed({text(mOutcome, "what"), text(mOutcome, "remedy"), text(mOutcome, "details")});
    else if (outcome.isEmpty() && !mCancelled)
    {
        Q_EMIT failed({tr("The installer ended too early."),
                       tr("Check that python3 is installed, then try again."),
                       QStringLiteral("%1, code %2\n%3")
                           .arg(status == QProcess::CrashExit ? mProcess.errorString() : QString())
                           .arg(code)
                           .arg(QString::fromUtf8(mProcess.readAllStandardError().right(4096)))});
    }
    Q_EMIT ended();
    if (outcome == QLatin1String("done") && mDoing == QLatin1String("install"))
        Q_EMIT installed();
}

} // namespace lampblack
