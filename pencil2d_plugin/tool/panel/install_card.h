// A card that installs the worker, or updates it.
#pragma once

#include "worker/installer.h"

#include <QFrame>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

namespace lampblack
{

/// Hidden until ask(). Says what will be installed, where and how large, and asks once. Shows the progress,
/// and what to do when it fails.
class InstallCard : public QFrame
{
    Q_OBJECT

public:
    /// `source` is the folder of the installer; where it is empty, there is none, and the card stays hidden.
    explicit InstallCard(const QString& source, QWidget* parent = nullptr);

    /// Look what there is, and offer to install it.
    void ask();

Q_SIGNALS:
    void installed(); ///< the worker can be started

private:
    void onPlanned(const InstallPlan& plan);
    void onProgress(const QString& what, qint64 done, qint64 total);
    void onFailed(const UserError& error);
    void run(const QString& wheels);
    void setBusy(bool busy);

    Installer* mInstaller = nullptr;
    QLabel* mWhat;
    QLabel* mHow;
    QProgressBar* mBar;
    QToolButton* mInstall;
    QToolButton* mFolder;
    QToolButton* mCancel;
    QToolButton* mCopy;
    QString mDetails;
};

} // namespace lampblack
