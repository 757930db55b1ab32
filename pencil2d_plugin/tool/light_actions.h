// The entries of the host's Animation menu under Light, and a job's progress in its status bar.
#pragma once

#include "host/host.h"

#include <QAction>
#include <QPointer>

namespace lampblack
{

class JobProgress;

class LightActions : public QObject
{
    Q_OBJECT

public:
    explicit LightActions(Host& host, QObject* parent = nullptr);
    ~LightActions() override;

    QAction* surfaces() const { return mSurfaces; } ///< "Generate Surfaces"
    QAction* render() const { return mRender; }     ///< "Render All Frames"
    QAction* keep() const { return mKeep; }         ///< "Keep the Light While Drawing"

    /// See JobProgress::setProgress().
    void setProgress(const QString& doing, int done, int total);
    /// Whether the progress, with its Cancel, is in sight somewhere else.
    void setSeenElsewhere(bool seen);

Q_SIGNALS:
    void cancelRequested();

private:
    void updateStatus();

    QAction* mSurfaces;
    QAction* mRender;
    QAction* mCancel;
    QAction* mKeep;
    QPointer<JobProgress> mStatus; ///< belongs to the host's window
    bool mSeenElsewhere = false;
};

} // namespace lampblack
