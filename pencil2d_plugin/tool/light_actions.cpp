#include "tool/light_actions.h"

#include "tool/panel/job_progress.h"

namespace lampblack
{

LightActions::LightActions(Host& host, QObject* parent)
    : QObject(parent), mSurfaces(new QAction(this)), mRender(new QAction(this)), mCancel(new QAction(this)),
      mKeep(new QAction(this)), mStatus(new JobProgress(QStringLiteral("lampblack.status"), true))
{
    const auto add = [&host](QAction* action, const QString& name, const QString& text, const QString& hint)
    {
        action->setObjectName(name);
        action->setText(text);
        action->setToolTip(hint);
        host.addLightAction(action);
    };
    add(mSurfaces, QStringLiteral("lampblack.surfaces"), tr("Generate Surfaces"),
        tr("Find the volume of every frame now. Then you see the light at once while you scrub and play."));
    add(mRender, QStringLiteral("lampblack.render"), tr("Render All Frames"),
        host.can(Host::Ability::Deliver)
            ? tr("Light every frame with the chosen quality. You get a layer \"Lit\", and picture files in "
                 "the "
                 "folder of the project")
            : tr("Light every frame with the chosen quality. You get picture files in a folder beside the "
                 "drawing"));
    add(mCancel, QStringLiteral("lampblack.cancel"), tr("Cancel"),
        tr("Stop generating or rendering. Frames that are done are kept."));
    mCancel->setEnabled(false);
    add(mKeep, QStringLiteral("lampblack.keep_light"), tr("Keep the Light While Drawing"),
        tr("The light stays on the canvas while you draw with other tools"));
    mKeep->setCheckable(true);
    mKeep->setChecked(true);
    connect(mCancel, &QAction::triggered, this, &LightActions::cancelRequested);
    connect(mStatus, &JobProgress::cancelRequested, this, &LightActions::cancelRequested);
    host.addStatusWidget(mStatus);
}

LightActions::~LightActions()
{
    delete mStatus;
}

void LightActions::setProgress(const QString& doing, int done, int total)
{
    for (QAction* action : {mSurfaces, mRender})
        action->setEnabled(total == 0);
    mCancel->setEnabled(total > 0);
    if (mStatus)
        mStatus->setProgress(doing, done, total);
    updateStatus();
}

void LightActions::setSeenElsewhere(bool seen)
{
    mSeenElsewhere = seen;
    updateStatus();
}

void LightActions::updateStatus()
{
    // Cancel must be in sight, but not twice.
    if (mStatus)
        mStatus->setVisible(mStatus->isRunning() && !mSeenElsewhere);
}

} // namespace lampblack
