#include "plugin/project_scene.h"

#include <QEvent>
#include <QMessageBox>

namespace lampblack
{

ProjectScene::ProjectScene(Host& host, SceneDocument& document, const LitLayer& layer, QObject* parent)
    : QObject(parent), mHost(host), mDocument(document), mLayer(layer)
{
    connect(&host, &Host::projectOpened, this, &ProjectScene::loadScene);
    connect(&host, &Host::projectSaved, this,
            [this](const QString& path)
            {
                // A project that was never lit gets no scene file.
                if (!mUntouched || mDocument.isModified())
                    mDocument.save(path);
            });
    connect(&host, &Host::frameExported, this,
            [this](const FrameExport& frame) { fitToCanvas(frame.image.size()); });
    connect(&document, &SceneDocument::modifiedChanged, this,
            [this](bool modified) { mHost.markModified(modified); });
    host.window()->installEventFilter(this);
    host.guardLeaving([this] { return mayLeave(); });
    loadScene(host.projectPath());
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
    const bool hasUnsaved = mDocument.isModified() || mLayer.isUnsaved();
    // If the project itself is modified, Pencil2D asks, and the scene is saved with the project.
    if (!hasUnsaved || mHost.projectPath().isEmpty() || mHost.isModified())
        return true;
    const QString title = mLayer.isUnsaved() ? tr("Save the lit layer?") : tr("Save the light?");
    const QString question =
        mLayer.isUnsaved()
            ? tr("The project has a new layer with lit frames, which is not saved. Save the project?")
            : tr("The light of this project was changed. Save it?");
    const auto answer = QMessageBox::question(mHost.window(), title, question,
                                              QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel,
                                              QMessageBox::Save);
    return answer == QMessageBox::Discard || (answer == QMessageBox::Save && saveAll());
}

bool ProjectScene::saveAll()
{
    const bool saved = !mLayer.isUnsaved() || mHost.saveProject();
    return saved && mDocument.save(mHost.projectPath());
}

void ProjectScene::loadScene(const QString& path)
{
    mUntouched = path.isEmpty() || !mDocument.load(path);
    if (mUntouched)
        mDocument.reset(defaultScene(mHost.canvasSize().expandedTo(QSize(1, 1))));
}

void ProjectScene::fitToCanvas(const QSize& size)
{
    if (sizeOf(mDocument.scene().canvas) == size || size.isEmpty())
        return;
    if (mUntouched && !mDocument.isModified())
        mDocument.reset(defaultScene(size));
}

} // namespace lampblack
