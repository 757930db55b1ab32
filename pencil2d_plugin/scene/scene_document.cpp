#include "scene/scene_document.h"

#include "scene/scene_file.h"

#include <QFileInfo>

namespace lampblack
{
namespace
{

constexpr int UndoSteps = 500;
const QString LayersField = QStringLiteral("pencil2d_layers");

QMap<QString, QString> rolesOf(const Scene& scene)
{
    QMap<QString, QString> roles;
    const QJsonObject tree = scene.extra.value(LayersField).toObject();
    for (auto role = tree.begin(); role != tree.end(); ++role)
    {
        if (role.value().isString())
        {
            roles.insert(role.key(), role.value().toString());
        }
    }
    return roles;
}

int firstLight(const Scene& scene)
{
    return scene.lights.isEmpty() ? -1 : 0;
}

} // namespace

/// Scenes before and after. The document is told in announce(), when the stack is whole again: whoever
/// listens may edit at once.
class SceneDocument::Edit : public QUndoCommand
{
public:
    Edit(const QString& text, Scene& target, Scene after, int gesture)
        : QUndoCommand(text), mTarget(target), mBefore(target), mAfter(std::move(after)), mGesture(gesture)
    {
    }

    int id() const override { return mGesture == 0 ? -1 : 1; }
    void undo() override { mTarget = mBefore; }
    void redo() override { mTarget = mAfter; }

    bool mergeWith(const QUndoCommand* next) override
    {
        const auto* later = dynamic_cast<const Edit*>(next);
        if (later == nullptr || later->mGesture != mGesture)
        {
            return false;
        }
        mAfter = later->mAfter;
        setObsolete(mAfter == mBefore); // a gesture that went back leaves no step
        return true;
    }

private:
    Scene& mTarget;
    Scene mBefore;
    Scene mAfter;
    int mGesture;
};

SceneDocument::SceneDocument(QObject* parent) : QObject(parent)
{
    mUndo.setUndoLimit(UndoSteps);
    connect(&mUndo, &QUndoStack::indexChanged, this, &SceneDocument::announce);
}

QMap<QString, QString> SceneDocument::layerRoles() const
{
    return rolesOf(mScene);
}

void SceneDocument::setLayerRoles(const QMap<QString, QString>& roles)
{
    QJsonObject tree;
    for (auto role = roles.begin(); role != roles.end(); ++role)
    {
        tree.insert(role.key(), role.value());
    }
    Scene changed = mScene;
    if (tree.isEmpty())
    {
        changed.extra.remove(LayersField);
    }
    else
    {
        changed.extra.insert(LayersField, tree);
    }
    edit(tr("Layers"), changed);
}

void SceneDocument::edit(const QString& text, const Scene& scene, int gesture)
{
    const Scene sound = clamped(scene);
    if (sound != mScene)
    {
        mUndo.push(new Edit(text, mScene, sound, gesture));
    }
}

void SceneDocument::selectLight(int index)
{
    const int sound = qBound(-1, index, mScene.lights.size() - 1);
    if (sound != mSelectedLight)
    {
        mSelectedLight = sound;
        Q_EMIT selectionChanged(sound);
    }
}

void SceneDocument::reset(const Scene& scene)
{
    mScene = clamped(scene);
    mKept = mScene;
    mUndo.clear();
    announce();
    selectLight(firstLight(mScene));
}

QString SceneDocument::sidecarOf(const QString& projectPath)
{
    return projectPath + QLatin1String(".lampblack.json");
}

bool SceneDocument::load(const QString& projectPath)
{
    const QString path = sidecarOf(projectPath);
    if (!QFileInfo::exists(path))
    {
        return false;
    }
    const auto read = readSceneFile(path);
    if (const auto* scene = std::get_if<Scene>(&read))
    {
        reset(*scene);
        return true;
    }
    UserError error = std::get<UserError>(read);
    const QString aside = setAside(path);
    if (!aside.isEmpty())
    {
        error.remedy = tr("The old file was kept as %1. Make new lights.").arg(QFileInfo(aside).fileName());
    }
    Q_EMIT problem(error);
    return false;
}

bool SceneDocument::save(const QString& projectPath)
{
    if (const std::optional<UserError> error = writeSceneFile(sidecarOf(projectPath), mScene))
    {
        Q_EMIT problem(*error);
        return false;
    }
    mKept = mScene;
    announce();
    return true;
}

void SceneDocument::announce()
{
    const Scene before = mAnnounced;
    mAnnounced = mScene;
    if (before != mScene)
    {
        Q_EMIT sceneChanged();
        selectLight(mSelectedLight);
        if (rolesOf(before) != rolesOf(mScene))
        {
            Q_EMIT layerRolesChanged();
        }
    }
    if (mAnnouncedModified != isModified())
    {
        mAnnouncedModified = isModified();
        Q_EMIT modifiedChanged(mAnnouncedModified);
    }
}

} // namespace lampblack
