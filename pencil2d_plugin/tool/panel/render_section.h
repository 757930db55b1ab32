// Jobs for the whole animation, and the worker's state.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/section.h"
#include "tool/shot_range.h"
#include "worker/worker.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>

namespace lampblack
{

class RenderSection : public Section
{
    Q_OBJECT

public:
    /// The actions behind the buttons.
    RenderSection(Host& host, SceneDocument& document, QAction& surfaces, QAction& render,
                  QWidget* parent = nullptr);

    /// How many frames of the result layer are out of date, and how many it has.
    void setOutdated(int outdated, int total);

    ShotRange range() const { return static_cast<ShotRange>(mRange->currentIndex()); }
    bool hidesSources() const { return mHide->isChecked(); }
    ApartKind apart() const;

Q_SIGNALS:
    void renderChangedRequested();

private:
    void refresh();
    void updateRenderText();

    SceneDocument& mDocument;
    /// Without layers that can be added, frames become files only.
    void restrictToFiles(const QString& reason);

    QAction& mRender;
    QComboBox* mRange;
    QComboBox* mQuality;
    QComboBox* mApart;
    QCheckBox* mHide;
    QPushButton* mRenderAll;
    QLabel* mOutdated;
    QPushButton* mRenderChanged;
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
