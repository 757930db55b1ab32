// The window of our own: a canvas, frames and menus. What it shows is the host's business.
#pragma once

#include "host/host.h"
#include "window/canvas_view.h"

#include <QLabel>
#include <QMainWindow>
#include <QSlider>

namespace lampblack
{

class MainWindow : public QMainWindow
{
    Q_OBJECT

public:
    MainWindow();

    CanvasView& canvas() { return mPaper->canvas(); }
    Paper& paper() { return *mPaper; }
    QMenu& lightMenu() { return *mLight; }
    void setFrames(FrameRange frames);
    void setFrame(int frame);

Q_SIGNALS:
    void openRequested(const QString& path);
    void saveRequested(); ///< the light
    void frameChosen(int frame);

protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

private:
    void addMenus();
    void addTimeline();
    void chooseFile();
    void chooseFolder();

    Paper* mPaper;
    QMenu* mLight = nullptr;
    QToolBar* mTimeline = nullptr;
    QSlider* mSlider = nullptr;
    QLabel* mNumber = nullptr;
};

} // namespace lampblack
