#include "plugin/project_scene.h"

#include <QEvent>
#include <QMessageBox>

namespace lampblack
{

ProjectScene::ProjectScene(Host& host, SceneDocument& document, const LitLayer& layer, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document), mLayer(layer)
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
    host.guardLeaving([this] { return mayLeave(); });
    open(host.projectPath());
}

ProjectScene::~ProjectScene()
{
    mHost.guardLeaving({});
}

bool ProjectScene::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::Close || watched != mHost.window() || mayLeave())
        return false;
    event->ignore();
    return true;
}

bool ProjectScene::mayLeave()
{
    const bool isLosing = mDocument.isModified() || mLayer.isUnsaved();
    // With changes of its own Pencil2D asks to save, and the light is saved with the project.
    if (!isLosing || mHost.projectPath().isEmpty() || mHost.isModified())
        return true;
    const QString title = mLayer.isUnsaved() ? tr("Save the lit layer?") : tr("Save the light?");
    const QString question =
        mLayer.isUnsaved() ? tr("The project has a new layer of lit frames, not saved yet. Save the project?")
                           : tr("The light of this project was changed. Save it?");
    const auto answer = QMessageBox::question(mHost.window(), title, question,
                                              QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel,
                                              QMessageBox::Save);
    return answer == QMessageBox::Discard || (answer == QMessageBox::Save && save());
}

bool ProjectScene::save()
{
    const bool saved = !mLayer.isUnsaved() || mHost.saveProject();
    return saved && mDocument.save(mHost.projectPath());
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
