// Jobs for the whole animation and their progress, and the worker's state.
#pragma once

#include "scene/scene_document.h"
#include "tool/panel/section.h"
#include "tool/shot_range.h"
#include "worker/worker.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>

namespace lampblack
{

class RenderSection : public Section
{
    Q_OBJECT

public:
    /// `render` is the action behind the button.
    RenderSection(SceneDocument& document, QAction& render, QWidget* parent = nullptr);

    /// `total` 0: no such job is running.
    void setSurfaceProgress(int done, int total);
    void setRenderProgress(int done, int total);

    /// How many frames of the result layer are out of date, and how many it has.
    void setOutdated(int outdated, int total);

    ShotRange range() const { return static_cast<ShotRange>(mRange->currentIndex()); }
    bool hidesSources() const { return mHide->isChecked(); }

Q_SIGNALS:
    void generateSurfacesRequested();
    void renderChangedRequested();
    void cancelRequested();

private:
    void refresh();
    void updateRenderText();
    void setProgress(QProgressBar* bar, int done, int total);

    SceneDocument& mDocument;
    QAction& mRender;
    QComboBox* mRange;
    QComboBox* mQuality;
    QCheckBox* mHide;
    QPushButton* mGenerate;
    QPushButton* mRenderAll;
    QLabel* mOutdated;
    QPushButton* mRenderChanged;
    QProgressBar* mSurfaceBar;
    QProgressBar* mRenderBar;
    QPushButton* mCancel;
};

/// The worker's state as text, with a coloured dot.
class WorkerLine : public QWidget
{
    Q_OBJECT

public:
    explicit WorkerLine(QWidget* parent = nullptr);

    void setState(Worker::State state);
    /// While the frame is not lit, a worker that is ready is at work for the artist.
    void setLit(bool lit);

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void refresh();

    QLabel* mText;
    QColor mDot;
    Worker::State mState = Worker::State::Absent;
    bool mLit = true;
};

} // namespace lampblack
