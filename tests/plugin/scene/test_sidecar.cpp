// The file beside the project: found again, never half written, never lost.
#include "scene/scene_document.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;

class SceneSidecar : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void savedAndFound();
    void noneIsNoFault();
    void brokenIsSetAside_data();
    void brokenIsSetAside();
    void brokenOnesAreAllKept();
    void saveDoesNotOverwriteABrokenOne();
    void materialsOfOtherColoursAreKept();
    void unwritableIsToldOf();

private:
    QByteArray contents(const QString& path) const;
    void write(const QByteArray& text) const;

    std::unique_ptr<QTemporaryDir> mFolder;
    QString mProject;
    QString mSidecar;
};

void SceneSidecar::init()
{
    mFolder = std::make_unique<QTemporaryDir>();
    mProject = mFolder->filePath(QStringLiteral("walk.pclx"));
    mSidecar = mFolder->filePath(QStringLiteral("walk.pclx.lampblack.json"));
}

QByteArray SceneSidecar::contents(const QString& path) const
{
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void SceneSidecar::write(const QByteArray& text) const
{
    QFile file(mSidecar);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(text);
}

void SceneSidecar::savedAndFound()
{
    SceneDocument first;
    first.reset(defaultScene({640, 480}));
    Scene scene = first.scene();
    scene.floor = Floor{400, 30};
    first.edit(QStringLiteral("Place floor"), scene);
    first.setLayerRoles({{QStringLiteral("Ink"), QStringLiteral("line")}});
    QVERIFY(first.isModified());
    QVERIFY(first.save(mProject));
    QVERIFY(!first.isModified());
    QCOMPARE(SceneDocument::sidecarOf(mProject), mSidecar);
    QCOMPARE(QDir(mFolder->path()).entryList(QDir::Files),
             QStringList(QStringLiteral("walk.pclx.lampblack.json")));

    SceneDocument second;
    QVERIFY(second.load(mProject));
    QVERIFY(second.scene() == first.scene());
    QCOMPARE(second.layerRoles(), first.layerRoles());
    QCOMPARE(second.selectedLight(), 0);
    QVERIFY(!second.isModified());
    QVERIFY(!second.undoStack()->canUndo());
}

void SceneSidecar::noneIsNoFault()
{
    SceneDocument document;
    QSignalSpy problems(&document, &SceneDocument::problem);
    QVERIFY(!document.load(mProject));
    QCOMPARE(problems.count(), 0);
}

void SceneSidecar::brokenIsSetAside_data()
{
    QTest::addColumn<QByteArray>("text");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("cut short") << QByteArray(R"({"canvas": {"width": 8,)");
    QTest::newRow("other version") << QByteArray(R"({"canvas": {"width": 8, "height": 8}, "version": 2})");
    QTest::newRow("out of range") << QByteArray(R"({"canvas": {"width": 0, "height": 8}})");
    QTest::newRow("too long") << R"({"canvas": {"width": 8, "height": 8}})" + QByteArray((1 << 20) + 1, ' ');
    QTest::newRow("too deep") << R"({"canvas": {"width": 8, "height": 8}, "a": )" + QByteArray(31, '[') +
                                     QByteArray(31, ']') + "}";
    QTest::newRow("deeper than the stack") << QByteArray(1 << 20, '[');
}

void SceneSidecar::brokenIsSetAside()
{
    QFETCH(QByteArray, text);
    write(text);
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    const Scene before = document.scene();
    QSignalSpy problems(&document, &SceneDocument::problem);
    QVERIFY(!document.load(mProject));
    QVERIFY(document.scene() == before);
    QCOMPARE(problems.count(), 1);
    const auto error = problems.first().first().value<UserError>();
    QVERIFY(error.what.contains(QLatin1String("walk.pclx.lampblack.json")));
    QVERIFY(error.remedy.contains(QLatin1String("walk.pclx.lampblack.json.broken")));
    QVERIFY(!error.details.isEmpty());
    QVERIFY(!QFile::exists(mSidecar));
    QCOMPARE(contents(mSidecar + QLatin1String(".broken")), text);
}

void SceneSidecar::brokenOnesAreAllKept()
{
    SceneDocument document;
    write("first");
    document.load(mProject);
    write("second");
    document.load(mProject);
    QCOMPARE(contents(mSidecar + QLatin1String(".broken")), QByteArray("first"));
    QCOMPARE(contents(mSidecar + QLatin1String(".broken2")), QByteArray("second"));
}

void SceneSidecar::saveDoesNotOverwriteABrokenOne()
{
    write("an artist's evening");
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    QVERIFY(document.save(mProject));
    QCOMPARE(contents(mSidecar + QLatin1String(".broken")), QByteArray("an artist's evening"));
    QVERIFY(SceneDocument().load(mProject));
}

void SceneSidecar::materialsOfOtherColoursAreKept()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    Scene scene = document.scene();
    scene.materials.insert(QStringLiteral("#010203"), {false, true, 0.9, 0.1, {}});
    document.edit(QStringLiteral("Gloss"), scene);
    QVERIFY(document.save(mProject));
    SceneDocument again;
    QVERIFY(again.load(mProject));
    QVERIFY(materialOf(again.scene(), QStringLiteral("#010203")).glossy);
    QVERIFY(!materialOf(again.scene(), QStringLiteral("#040506")).glossy);
}

void SceneSidecar::unwritableIsToldOf()
{
    SceneDocument document;
    document.reset(defaultScene({640, 480}));
    QSignalSpy problems(&document, &SceneDocument::problem);
    QVERIFY(!document.save(mFolder->filePath(QStringLiteral("nowhere/walk.pclx"))));
    QCOMPARE(problems.count(), 1);
}

QTEST_GUILESS_MAIN(SceneSidecar)
#include "test_sidecar.moc"
