#include "plugin/project_scene.h"

#include <QEvent>
#include <QMessageBox>

namespace lampblack
{

ProjectScene::ProjectScene(Host& host, SceneDocument& document, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document)
{
    connect(&host, &Host::projectOpened, this, &ProjectScene::open);
    connect(&host, &Host::projectSaved, this,
            [this](const QString& path)
            {
                // A project that was never lit gets no file beside it.
                if (!mFresh || mDocument.isModified())
                    mDocument.save(path);
            });
    connect(&host, &Host::frameExported, this,
            [this](const FrameExport& frame) { fitCanvas(frame.image.size()); });
    host.window()->installEventFilter(this);
    open(host.projectPath());
}

bool ProjectScene::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::Close || watched != mHost.window() || !mDocument.isModified() ||
        mHost.projectPath().isEmpty())
        return false;
    // With changes of its own Pencil2D asks to save, and the light is saved with the project.
    if (mHost.isModified())
        return false;
    const auto answer = QMessageBox::question(
        mHost.window(), tr("Save the light?"), tr("The light of this project was changed. Save it?"),
        QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, QMessageBox::Save);
    const bool stay = answer == QMessageBox::Cancel ||
                      (answer == QMessageBox::Save && !mDocument.save(mHost.projectPath()));
    if (stay)
        event->ignore();
    return stay;
}

void ProjectScene::open(const QString& path)
{
    mFresh = path.isEmpty() || !mDocument.load(path);
    if (mFresh)
        mDocument.reset(defaultScene(mHost.canvasSize().expandedTo(QSize(1, 1))));
}

void ProjectScene::fitCanvas(const QSize& size)
{
    if (mDocument.scene().canvas == size || size.isEmpty())
        return;
    if (mFresh && !mDocument.isModified())
        mDocument.reset(defaultScene(size));
}

} // namespace lampblack
