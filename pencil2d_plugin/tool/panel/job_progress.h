// How far a job for the whole animation is, with a button that ends it.
#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>

namespace lampblack
{

/// Hidden while no job runs.
class JobProgress : public QWidget
{
    Q_OBJECT

public:
    /// `name` begins the objectNames: "<name>.progress" and "<name>.cancel". A `compact` one has one line,
    /// for a status bar.
    JobProgress(const QString& name, bool compact, QWidget* parent = nullptr);

    /// `doing` names the work, such as "Rendering". `total` 0: no job is running.
    void setProgress(const QString& doing, int done, int total);
    bool isRunning() const { return mBar->maximum() > 0; }

Q_SIGNALS:
    void cancelRequested();

private:
    QLabel* mDoing;
    QProgressBar* mBar;
    QPushButton* mCancel;
};

} // namespace lampblack
