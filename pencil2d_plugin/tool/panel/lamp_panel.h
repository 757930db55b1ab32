// The lamp's panel in the tool options.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/panel/borrowed_height.h"
#include "tool/panel/problem_card.h"
#include "tool/panel/render_section.h"

#include <QButtonGroup>
#include <QLabel>
#include <QScrollArea>

namespace lampblack
{

/// It scrolls, so that it fits into the smallest dock. It shows and edits the document.
class LampPanel : public QScrollArea
{
    Q_OBJECT

public:
    /// `render` is the action behind "Render All Frames".
    LampPanel(Host& host, SceneDocument& document, QAction& render);

    std::optional<Show> viewMode() const; ///< see LampTool::viewMode()
    void setViewMode(std::optional<Show> mode);
    void setWorkerState(Worker::State state) { mWorkerLine->setState(state); }
    void setLit(bool lit) { mWorkerLine->setLit(lit); } ///< see LampTool::setLit()
    void showProblem(const UserError& error);
    RenderSection* render() { return mRender; }

    QSize sizeHint() const override;

Q_SIGNALS:
    void viewModeChanged(std::optional<lampblack::Show> mode);

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

private:
    QWidget* viewSwitch();

    QButtonGroup* mViews;
    QLabel* mDepthHelp;
    ProblemCard* mProblem;
    RenderSection* mRender;
    WorkerLine* mWorkerLine;
    BorrowedHeight mHeight;
};

} // namespace lampblack
