#include "window/main_window.h"

#include <QDragEnterEvent>
#include <QFileDialog>
#include <QMenuBar>
#include <QMimeData>
#include <QStatusBar>
#include <QToolBar>

namespace lampblack
{

namespace
{

/// The one local file or folder that is dropped; empty for anything else.
QString droppedPath(const QMimeData& data)
{
    const QList<QUrl> urls = data.urls();
    return urls.size() == 1 ? urls.first().toLocalFile() : QString();
}

} // namespace

MainWindow::MainWindow() : mPaper(new Paper(this))
{
    setObjectName(QStringLiteral("lampblack.window"));
    setAcceptDrops(true);
    setCentralWidget(mPaper);
    setWindowTitle(tr("Lampblack"));
    mPaper->setHint(tr("Open a drawing of any program with File > Open, or drop it here.\n"
                       "Draw in your own program. When you save there, the light follows here."));
    addMenus();
    addTimeline();
    statusBar();
    setFrames({});
}

void MainWindow::addMenus()
{
    QMenu* file = menuBar()->addMenu(tr("&File"));
    file->addAction(tr("&Open…"), this, &MainWindow::chooseFile, QKeySequence::Open);
    file->addAction(tr("Open a &Folder of Frames…"), this, &MainWindow::chooseFolder);
    QAction* save =
        file->addAction(tr("&Save the Light"), this, &MainWindow::saveRequested, QKeySequence::Save);
    save->setObjectName(QStringLiteral("lampblack.window.save"));
    file->addSeparator();
    file->addAction(tr("&Quit"), this, &QWidget::close, QKeySequence::Quit);
    QMenu* view = menuBar()->addMenu(tr("&View"));
    CanvasView* canvas = &this->canvas();
    view->addAction(tr("&Whole Drawing"), canvas, &CanvasView::fit, QKeySequence(tr("Ctrl+0")));
    view->addAction(tr("&Actual Size"), canvas, &CanvasView::showActualSize, QKeySequence(tr("Ctrl+1")));
    view->addAction(tr("Zoom &In"), canvas, &CanvasView::zoomIn, QKeySequence::ZoomIn);
    view->addAction(tr("Zoom &Out"), canvas, &CanvasView::zoomOut, QKeySequence::ZoomOut);
    mLight = menuBar()->addMenu(tr("&Light"));
}

void MainWindow::addTimeline()
{
    mTimeline = new QToolBar(tr("Frames"), this);
    mTimeline->setObjectName(QStringLiteral("lampblack.window.timeline"));
    mTimeline->setMovable(false);
    mSlider = new QSlider(Qt::Horizontal);
    mSlider->setObjectName(QStringLiteral("lampblack.window.frame"));
    mSlider->setAccessibleName(tr("Frame"));
    mNumber = new QLabel;
    mNumber->setObjectName(QStringLiteral("lampblack.window.number"));
    const auto step = [this](const QString& text, const QString& hint, int frames, const QKeySequence& key)
    {
        QAction* action = mTimeline->addAction(text);
        action->setToolTip(hint);
        action->setShortcut(key);
        connect(action, &QAction::triggered, mSlider,
                [this, frames] { mSlider->setValue(mSlider->value() + frames); });
    };
    // The same keys as in Pencil2D.
    step(QStringLiteral("◀"), tr("Previous frame (,)"), -1, QKeySequence(Qt::Key_Comma));
    mTimeline->addWidget(mSlider);
    step(QStringLiteral("▶"), tr("Next frame (.)"), 1, QKeySequence(Qt::Key_Period));
    mTimeline->addWidget(mNumber);
    addToolBar(Qt::BottomToolBarArea, mTimeline);
    connect(mSlider, &QSlider::valueChanged, this, &MainWindow::frameChosen);
}

void MainWindow::setFrames(FrameRange frames)
{
    {
        const QSignalBlocker blocker(mSlider); // the host says which frame it is
        mSlider->setRange(frames.first, frames.last);
    }
    mTimeline->setVisible(frames.last > frames.first);
    setFrame(mSlider->value());
}

void MainWindow::setFrame(int frame)
{
    const QSignalBlocker blocker(mSlider);
    mSlider->setValue(frame);
    mNumber->setText(
        mSlider->minimum() == 1
            ? tr("Frame %1 of %2").arg(frame).arg(mSlider->maximum())
            : tr("Frame %1 (%2 to %3)").arg(frame).arg(mSlider->minimum()).arg(mSlider->maximum()));
}

void MainWindow::chooseFile()
{
    const QString path = QFileDialog::getOpenFileName(
        this, tr("Open a drawing"), {},
        tr("Drawings (*.pclx *.pcl *.ora *.psd *.psb *.kra *.png *.tif *.tiff *.tga *.webp *.jpg *.jpeg);;"
           "All files (*)"));
    if (!path.isEmpty())
        Q_EMIT openRequested(path);
}

void MainWindow::chooseFolder()
{
    const QString path = QFileDialog::getExistingDirectory(this, tr("The folder with the frames"));
    if (!path.isEmpty())
        Q_EMIT openRequested(path);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
    if (!droppedPath(*event->mimeData()).isEmpty())
        event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event)
{
    Q_EMIT openRequested(droppedPath(*event->mimeData()));
}

} // namespace lampblack
