// Installs, updates and removes the worker in the user's data folder.
#pragma once

#include "user_error.h"

#include <QJsonObject>
#include <QObject>
#include <QProcess>

namespace lampblack
{

/// What would be installed, as install_worker.py says.
struct InstallPlan
{
    enum class State
    {
        Absent,
        Half,  ///< an installation was not finished
        Other, ///< of another version than the plugin
        Installed
    };
    State state = State::Absent;
    QString version;
    QString folder;
    qint64 download = 0; ///< bytes
    qint64 disk = 0;     ///< bytes
};

/// Runs `python3 install_worker.py` as a child. One thing at a time; all calls return at once.
class Installer : public QObject
{
    Q_OBJECT

public:
    /// `source` is the folder of install_worker.py.
    explicit Installer(const QString& source, QObject* parent = nullptr);
    /// Cancels. What was downloaded is kept.
    ~Installer() override;

    bool isRunning() const { return mProcess.state() != QProcess::NotRunning; }
    void plan();
    /// From the package index, or from the wheels in a folder.
    void install(const QString& wheels = {});
    void remove();
    void cancel();

Q_SIGNALS:
    void planned(const lampblack::InstallPlan& plan);
    void progressed(const QString& what, qint64 done, qint64 total); ///< bytes; total 0: not known
    void failed(const lampblack::UserError& error);
    void ended();     ///< whatever came of it
    void installed(); ///< last

private:
    void start(const QString& what, const QString& wheels = {});
    void read();
    void onFinished(int code, QProcess::ExitStatus status);

    const QString mSource;
    QProcess mProcess;
    QString mDoing;
    QJsonObject mPlan;
    QJsonObject mOutcome; ///< what it said last: "done" or "error"
    bool mCancelled = false;
};

/// The folder of looks, rigs and the worker of this user.
QString dataFolder();

} // namespace lampblack
