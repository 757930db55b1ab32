// The document: edits, gestures, undo, selection, layers, and what listeners are told.
#include "scene/scene_document.h"

#include <QSignalSpy>
#include <QtTest>

using namespace lampblack;

class SceneUndo : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void aDragIsOneStep();
    void aGestureThatGoesBackLeavesNothing();
    void gesturesApartAreStepsApart();
    void nothingChangedIsNoStep();
    void valuesAreClamped();
    void selectionStaysSane();
    void layerRolesGoWithTheScene();
    void modifiedIsByContent();
    void listenersMayEdit();
    void resetForgets();

private:
    static Scene moved(const SceneDocument& document, double x);
};

Scene SceneUndo::moved(const SceneDocument& document, double x)
{
    Scene scene = document.scene();
    scene.lights[0].x = x;
    return scene;
}

void SceneUndo::aDragIsOneStep()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    const Scene before = document.scene();
    QSignalSpy changes(&document, &SceneDocument::sceneChanged);
    for (int x = 0; x < 100; ++x)
    {
        document.edit(QStringLiteral("Move light"), moved(document, x), 7);
    }
    QCOMPARE(changes.count(), 100);
    QCOMPARE(document.undoStack()->count(), 1);
    QCOMPARE(document.undoStack()->undoText(), QStringLiteral("Move light"));
    document.undoStack()->undo();
    QVERIFY(document.scene() == before);
    QCOMPARE(changes.count(), 101);
    document.undoStack()->redo();
    QCOMPARE(document.scene().lights[0].x, 99.0);
}

void SceneUndo::aGestureThatGoesBackLeavesNothing()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    const Scene before = document.scene();
    document.edit(QStringLiteral("Move light"), moved(document, 5), 7);
    document.edit(QStringLiteral("Move light"), before, 7);
    QVERIFY(!document.undoStack()->canUndo());
    QVERIFY(!document.undoStack()->canRedo());
    QVERIFY(document.scene() == before);
    QVERIFY(!document.isModified());
}

void SceneUndo::gesturesApartAreStepsApart()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    document.edit(QStringLiteral("a"), moved(document, 1), 7);
    document.edit(QStringLiteral("b"), moved(document, 2), 8);
    document.edit(QStringLiteral("c"), moved(document, 3));
    document.edit(QStringLiteral("d"), moved(document, 4));
    QCOMPARE(document.undoStack()->count(), 4);
}

void SceneUndo::nothingChangedIsNoStep()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    QSignalSpy changes(&document, &SceneDocument::sceneChanged);
    document.edit(QStringLiteral("a"), document.scene());
    QCOMPARE(changes.count(), 0);
    QCOMPARE(document.undoStack()->count(), 0);
}

void SceneUndo::valuesAreClamped()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    document.edit(QStringLiteral("a"), moved(document, 1e9));
    QCOMPARE(document.scene().lights[0].x, 1e5);
}

void SceneUndo::selectionStaysSane()
{
    SceneDocument document;
    QCOMPARE(document.selectedLight(), -1);
    document.reset(defaultScene({640, 480}));
    QCOMPARE(document.selectedLight(), 0);
    Scene two = document.scene();
    two.lights.append(two.lights[0]);
    document.edit(QStringLiteral("Add light"), two);
    document.selectLight(1);
    QSignalSpy selections(&document, &SceneDocument::selectionChanged);
    document.undoStack()->undo();
    QCOMPARE(document.selectedLight(), 0);
    QCOMPARE(selections.count(), 1);
    document.selectLight(5);
    QCOMPARE(document.selectedLight(), 0);
    Scene dark = document.scene();
    dark.lights.clear();
    document.edit(QStringLiteral("Delete light"), dark);
    QCOMPARE(document.selectedLight(), -1);
}

void SceneUndo::layerRolesGoWithTheScene()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    QSignalSpy changes(&document, &SceneDocument::layerRolesChanged);
    const QMap<QString, QString> roles = {{QStringLiteral("Figur \u00e4"), QStringLiteral("character")},
                                          {QStringLiteral("Sky"), QStringLiteral("background")}};
    document.setLayerRoles(roles);
    QCOMPARE(document.layerRoles(), roles);
    QCOMPARE(changes.count(), 1);
    QCOMPARE(toJson(document.scene()).value(QLatin1String("pencil2d_layers")).toObject().size(), 2);
    document.edit(QStringLiteral("Move light"), moved(document, 5));
    QCOMPARE(changes.count(), 1);
    document.undoStack()->setIndex(0);
    QVERIFY(document.layerRoles().isEmpty());
    QCOMPARE(changes.count(), 2);
    document.setLayerRoles({});
    QVERIFY(!document.undoStack()->canUndo());
}

void SceneUndo::modifiedIsByContent()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    QSignalSpy changes(&document, &SceneDocument::modifiedChanged);
    document.edit(QStringLiteral("a"), moved(document, 5));
    document.edit(QStringLiteral("a"), moved(document, 6));
    QVERIFY(document.isModified());
    document.undoStack()->setIndex(0);
    QVERIFY(!document.isModified());
    QCOMPARE(changes, (QList<QVariantList>{{true}, {false}}));
}

void SceneUndo::listenersMayEdit()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    connect(&document, &SceneDocument::sceneChanged, this,
            [&document]
            {
                Scene dimmed = document.scene();
                dimmed.ambient.strength = 0.1;
                document.edit(QStringLiteral("Dim"), dimmed);
            });
    document.edit(QStringLiteral("Move light"), moved(document, 5));
    QCOMPARE(document.undoStack()->count(), 2);
    QCOMPARE(document.undoStack()->undoText(), QStringLiteral("Dim"));
    QCOMPARE(document.scene().lights[0].x, 5.0);
    QCOMPARE(document.scene().ambient.strength, 0.1);
}

void SceneUndo::resetForgets()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    document.edit(QStringLiteral("a"), moved(document, 5));
    QSignalSpy changes(&document, &SceneDocument::sceneChanged);
    document.reset(defaultScene({64, 48}));
    QCOMPARE(changes.count(), 1);
    QCOMPARE(document.undoStack()->count(), 0);
    QVERIFY(!document.isModified());
    QCOMPARE(sizeOf(document.scene().canvas), QSize(64, 48));
}

QTEST_GUILESS_MAIN(SceneUndo)
#include "test_undo.moc"
