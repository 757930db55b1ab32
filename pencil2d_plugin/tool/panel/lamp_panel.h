// The lamp's panel in the tool options.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/borrowed_height.h"
#include "tool/panel/device_row.h"
#include "tool/panel/install_card.h"
#include "tool/panel/job_progress.h"
#include "tool/panel/problem_card.h"
#include "tool/panel/render_section.h"

#include <QButtonGroup>
#include <QLabel>
#include <QScrollArea>

namespace lampblack
{

/// It scrolls, so that it fits into the smallest dock. The view switch, the state and a running job stay in
/// sight above. It shows and edits the document.
class LampPanel : public QScrollArea
{
    Q_OBJECT

public:
    /// `surfaces` and `render` are the actions behind "Generate Surfaces" and "Render All Frames".
    LampPanel(Host& host, SceneDocument& document, QAction& surfaces, QAction& render);

    std::optional<Show> viewMode() const; ///< see LampTool::viewMode()
    void setViewMode(std::optional<Show> mode);
    void setWorkerState(Worker::State state);
    void setLit(bool lit) { mWorkerLine->setLit(lit); } ///< see LampTool::setLit()
    void showProblem(const UserError& error);
    /// Problems of this kind are over.
    void settleProblem(UserError::Kind kind) { mProblem->settle(kind); }
    RenderSection* render() { return mRender; }
    DeviceRow* device() { return mDevice; }
    JobProgress* progress() { return mProgress; }

    QSize sizeHint() const override;

Q_SIGNALS:
    void viewModeChanged(std::optional<lampblack::Show> mode);
    void retryRequested(); ///< start the worker again

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QWidget* viewSwitch();
    void addHeader(const QFont& font);
    void placeHeader();
    void restoreSections(Host& host);
    void closeDialogs();

    QButtonGroup* mViews;
    QLabel* mDepthHelp;
    ProblemCard* mProblem;
    InstallCard* mInstall;
    RenderSection* mRender;
    DeviceRow* mDevice;
    WorkerLine* mWorkerLine;
    JobProgress* mProgress;
    QWidget* mHeader; ///< above the part that scrolls
    BorrowedHeight mHeight;
};

} // namespace lampblack
