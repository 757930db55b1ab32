#include "tool/panel/install_card.h"

#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLocale>
#include <QVBoxLayout>

#include <algorithm>

namespace lampblack
{

namespace
{

constexpr int BarSteps = 1000;

QString sized(qint64 bytes)
{
    return QLocale().formattedDataSize(bytes, 1, QLocale::DataSizeSIFormat);
}

} // namespace

InstallCard::InstallCard(const QString& source, QWidget* parent)
    : QFrame(parent), mWhat(new QLabel(this)), mHow(new QLabel(this)), mBar(new QProgressBar(this)),
      mInstall(new QToolButton(this)), mFolder(new QToolButton(this)), mCancel(new QToolButton(this)),
      mCopy(new QToolButton(this))
{
    setObjectName(QStringLiteral("lampblack.panel.install"));
    setFrameShape(QFrame::StyledPanel);
    for (QLabel* label : {mWhat, mHow})
    {
        label->setWordWrap(true);
        label->setTextFormat(Qt::PlainText);
        label->setTextInteractionFlags(Qt::TextSelectableByMouse);
        // A long path must not widen the dock.
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    }
    mWhat->setObjectName(QStringLiteral("lampblack.panel.install.what"));
    mHow->setObjectName(QStringLiteral("lampblack.panel.install.how"));
    QFont bold = mWhat->font();
    bold.setBold(true);
    mWhat->setFont(bold);
    mBar->setObjectName(QStringLiteral("lampblack.panel.install.bar"));
    mBar->setTextVisible(false);
    auto* buttons = new QHBoxLayout;
    const auto addButton = [buttons](QToolButton* button, const QString& name, const QString& text)
    {
        button->setObjectName(QStringLiteral("lampblack.panel.install.") + name);
        button->setText(text);
        buttons->addWidget(button);
    };
    addButton(mInstall, QStringLiteral("install"), tr("Install"));
    addButton(mFolder, QStringLiteral("folder"), tr("From a Folder..."));
    addButton(mCancel, QStringLiteral("cancel"), tr("Cancel"));
    addButton(mCopy, QStringLiteral("copy"), tr("Copy Details"));
    mFolder->setToolTip(tr("Without internet: the folder lampblack-wheels, with all packages in it"));
    buttons->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(8, 6, 4, 4);
    column->setSpacing(3);
    column->addWidget(mWhat);
    column->addWidget(mHow);
    column->addWidget(mBar);
    column->addLayout(buttons);
    hide();
    if (source.isEmpty())
        return;
    mInstaller = new Installer(source, this);
    connect(mInstaller, &Installer::planned, this, &InstallCard::onPlanned);
    connect(mInstaller, &Installer::progressed, this, &InstallCard::onProgress);
    connect(mInstaller, &Installer::failed, this, &InstallCard::onFailed);
    connect(mInstaller, &Installer::installed, this,
            [this]
            {
                hide();
                Q_EMIT installed();
            });
    connect(mInstaller, &Installer::ended, this, [this] { setBusy(false); });
    connect(mInstall, &QToolButton::clicked, this, [this] { run({}); });
    connect(mFolder, &QToolButton::clicked, this,
            [this]
            {
                const QString folder =
                    QFileDialog::getExistingDirectory(window(), tr("The folder with the wheels"));
                if (!folder.isEmpty())
                    run(folder);
            });
    connect(mCancel, &QToolButton::clicked, this,
            [this]
            {
                mInstaller->cancel();
                mWhat->setText(tr("The renderer is not installed yet."));
                mHow->setText(tr("Cancelled. The downloaded files are kept. Install continues from there."));
            });
    connect(mCopy, &QToolButton::clicked, this, [this] { QApplication::clipboard()->setText(mDetails); });
}

void InstallCard::ask()
{
    if (mInstaller == nullptr || mInstaller->isRunning())
        return;
    mInstaller->plan();
}

void InstallCard::onPlanned(const InstallPlan& plan)
{
    const QString where = QDir::toNativeSeparators(plan.folder);
    QString how =
        plan.download > 0
            ? tr("Into %1. Download: %2. On disk: %3.").arg(where, sized(plan.download), sized(plan.disk))
            : tr("Into %1. On disk: %2.").arg(where, sized(plan.disk));
    switch (plan.state)
    {
    case InstallPlan::State::Absent:
        mWhat->setText(
            tr("The lamp needs its renderer: Blender's Cycles and a network, version %1.").arg(plan.version));
        break;
    case InstallPlan::State::Half:
        mWhat->setText(tr("The installation of the renderer was not finished."));
        break;
    case InstallPlan::State::Other:
        mWhat->setText(
            tr("The renderer is of another version than the lamp, which is %1.").arg(plan.version));
        break;
    case InstallPlan::State::Installed:
        mWhat->setText(tr("The renderer does not start. Install it again."));
        break;
    }
    mInstall->setText(plan.state == InstallPlan::State::Other ? tr("Update") : tr("Install"));
    mHow->setText(how);
    mDetails.clear();
    setBusy(false);
    show();
}

void InstallCard::run(const QString& wheels)
{
    mDetails.clear();
    mWhat->setText(tr("Installing the renderer"));
    mInstaller->install(wheels);
    setBusy(true);
}

void InstallCard::onProgress(const QString& what, qint64 done, qint64 total)
{
    mBar->setRange(0, total > 0 ? BarSteps : 0); // 0 to 0 shows that it is at work
    if (total > 0)
        mBar->setValue(int(BarSteps * std::min(done, total) / total));
    mHow->setText(total > 0 ? tr("%1: %2 of %3").arg(what, sized(done), sized(total)) : what);
}

void InstallCard::onFailed(const UserError& error)
{
    mWhat->setText(error.what);
    mHow->setText(error.remedy);
    mDetails = QStringList{error.what, error.remedy, error.details}.join(QLatin1Char('\n'));
    setBusy(false);
    show();
}

void InstallCard::setBusy(bool busy)
{
    mBar->setVisible(busy);
    mCancel->setVisible(busy);
    mInstall->setVisible(!busy);
    mFolder->setVisible(!busy);
    mCopy->setVisible(!busy && !mDetails.isEmpty());
}

} // namespace lampblack
