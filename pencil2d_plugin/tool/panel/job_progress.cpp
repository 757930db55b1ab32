#include "tool/panel/job_progress.h"

#include <QGridLayout>

namespace lampblack
{

namespace
{
constexpr int CompactWidth = 160; // pixels of the bar
}

JobProgress::JobProgress(const QString& name, bool compact, QWidget* parent)
    : QWidget(parent), mDoing(new QLabel(this)), mBar(new QProgressBar(this)),
      mCancel(new QPushButton(tr("Cancel"), this))
{
    setObjectName(name + QStringLiteral(".job"));
    mBar->setObjectName(name + QStringLiteral(".progress"));
    mBar->setRange(0, 0);
    mCancel->setObjectName(name + QStringLiteral(".cancel"));
    mCancel->setToolTip(tr("Stop. Frames that are done are kept."));
    mCancel->setAutoDefault(false);
    auto* grid = new QGridLayout(this);
    grid->setContentsMargins(0, 0, 0, 0);
    grid->setSpacing(3);
    if (compact)
    {
        mDoing->hide(); // the status bar says it
        mBar->setFixedWidth(CompactWidth);
        grid->addWidget(mBar, 0, 0);
        grid->addWidget(mCancel, 0, 1);
    }
    else
    {
        mDoing->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        grid->setColumnStretch(0, 1);
        grid->addWidget(mDoing, 0, 0);
        grid->addWidget(mCancel, 0, 1);
        grid->addWidget(mBar, 1, 0, 1, 2);
    }
    connect(mCancel, &QPushButton::clicked, this, &JobProgress::cancelRequested);
    hide();
}

void JobProgress::setProgress(const QString& doing, int done, int total)
{
    mDoing->setText(doing);
    mBar->setAccessibleName(doing);
    mBar->setFormat(tr("%v of %m"));
    mBar->setRange(0, total);
    mBar->setValue(done);
    setVisible(total > 0);
}

} // namespace lampblack
